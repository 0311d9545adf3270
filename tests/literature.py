"""What data/ holds of the shipped devices."""

from pathlib import Path

from fingerpad.perception.ratings import read_literature
from scenes import scene

DATA = Path(__file__).parents[1] / "data"
CONDITIONS = {name: [each.name for each in scene(name).device.conditions] for name in ("device1", "device2", "device3")}
LITERATURE = read_literature(DATA / "ratings.csv", DATA / "stated_order.csv", DATA / "published_r2.csv", CONDITIONS)
