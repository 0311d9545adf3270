"""Full fields of solved states as VTU files, which ParaView opens, and as a collection of states in time.

Every second-order triangle has six points of its own, as strain and stress jump between elements. Arrays carry their
unit in their name, if they have one. Tensors have the components xx, yy, zz, xy, yz, xz, as VTK orders symmetric ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np

from ..arrays import FloatArray
from ..files import replacing, write_text
from ..readouts.strain import maximum_principal
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.mesh import NODES, SectionMesh, counterclockwise, element_nodes
from ..tissue.reach import contact_tractions
from .states import States, strain_at, stress_at

STRAIN = {Kinematics.SMALL: "strain", Kinematics.FINITE: "logarithmic_strain"}  # what the arrays are called
STRESS = {Kinematics.SMALL: "stress_MPa", Kinematics.FINITE: "cauchy_stress_MPa"}
SYMMETRIC = 6  # components of a symmetric tensor [1]


def field_meshes(section: SectionMesh, scene: Scene, states: States) -> Iterator[meshio.Mesh]:
    """The undeformed section with the fields of each state, one after the other: a mesh has some 10 MB.

    At points: displacement_mm, strain (tensor, exy = gxy / 2), maximum_principal_strain, stress_MPa (of the element's
    own layer), contact_pressure_MPa and contact_shear_MPa of the actuators on the skin (over undeformed length), zero
    elsewhere. With finite kinematics strain and stress are called what they are then, logarithmic_strain (of material
    directions) and cauchy_stress_MPa. In cells: layer, counted from the pad's skin inwards and on with the dorsal ones.

    Raises MeshError as `contact_tractions`.
    """
    mesh = section.mesh
    order, own = counterclockwise(mesh), element_nodes(mesh).ravel()
    point = (NODES.shape[1] * np.arange(len(order))[:, None] + order).ravel()
    cells = [("triangle6", np.arange(own.size).reshape(order.shape))]
    tractions = skin_tractions(section, scene, states.contact)
    for moved, traction in zip(states.displacement, tractions, strict=True):
        components = strain_at(scene, mesh, moved, NODES)[point]
        stresses = stress_at(scene, section, moved, NODES)[point]
        exx, eyy, gxy = components.T
        nothing = np.zeros_like(exx)
        point_data = {
            "displacement_mm": _in_space(moved[:, own]),
            STRAIN[scene.kinematics]: _symmetric(exx, eyy, nothing, gxy / 2.0),
            "maximum_principal_strain": maximum_principal(components.ravel()),
            STRESS[scene.kinematics]: _symmetric(*stresses.T),
            "contact_pressure_MPa": traction[1, own],
            "contact_shear_MPa": traction[0, own],
        }
        yield meshio.Mesh(_in_space(mesh.doflocs[:, own]), cells, point_data, {"layer": [section.layer]})


def skin_tractions(section: SectionMesh, scene: Scene, forces: FloatArray) -> FloatArray:
    """Shear and pressure of the actuators on all nodes (n_states, 2, n_nodes) [MPa]: linear between the skin's
    vertices, zero off the skin that an actuator can reach. Raises MeshError as `contact_tractions`.
    """
    tractions = contact_tractions(section, scene)
    vertices = np.isin(section.skin[::2], tractions.nodes)
    on_skin = np.zeros((len(forces), 2, section.skin.size))
    on_skin[:, :, np.flatnonzero(vertices) * 2] = (forces / tractions.weight[:, None]).transpose(0, 2, 1)
    on_skin[:, :, 1::2] = (on_skin[:, :, :-2:2] + on_skin[:, :, 2::2]) / 2.0
    everywhere = np.zeros((len(forces), 2, section.mesh.doflocs.shape[1]))
    everywhere[:, :, section.skin] = on_skin
    return everywhere


def write_vtu(path: Path, mesh: meshio.Mesh) -> None:
    """Write one state as a compressed VTU file."""
    with replacing(path) as part:
        meshio.write(part, mesh, file_format="vtu")


def write_path(pvd: Path, folder: Path, last: Path, times: FloatArray, meshes: Iterable[meshio.Mesh]) -> None:
    """Write a path: the last state as a file of its own, those before in a folder, and the PVD file of all, whose times
    (n_states,) [s] begin with that of pre-indentation. States in the folder that the PVD file named before, of a longer
    path, go away.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = [*(folder / f"{number:04d}.vtu" for number in range(times.size - 1)), last]
    before = [file for file in _collected(pvd) if file.parent == folder]
    for file, mesh in zip(files, meshes, strict=True):
        write_vtu(file, mesh)
    write_collection(pvd, times, files)
    for stale in set(before) - set(files):
        stale.unlink(missing_ok=True)


def _collected(path: Path) -> list[Path]:
    """The files that a PVD file names; none if there is no such file."""
    with suppress(FileNotFoundError, ElementTree.ParseError):
        sets = ElementTree.parse(path).getroot().findall("Collection/DataSet")
        return [path.parent / each.get("file", "") for each in sets]
    return []


def write_collection(path: Path, times: FloatArray, files: Sequence[Path]) -> None:
    """Write a PVD file that names the VTU file of each time (n_states,) [s]; files lie in or below its folder."""
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for time, file in zip(times, files, strict=True):
        name = file.relative_to(path.parent).as_posix()
        ElementTree.SubElement(collection, "DataSet", timestep=repr(float(time)), part="0", file=name)
    ElementTree.indent(root)
    write_text(path, ElementTree.tostring(root, encoding="unicode") + "\n")


def _in_space(plane: FloatArray) -> FloatArray:
    """Vectors (n, 3) from their components in the plane (2, n)."""
    return np.stack([*plane, np.zeros(plane.shape[1])], axis=1)


def _symmetric(xx: FloatArray, yy: FloatArray, zz: FloatArray, xy: FloatArray) -> FloatArray:
    """Symmetric tensors (n, 6) without shear out of the plane."""
    found = np.zeros((xx.size, SYMMETRIC))
    for column, values in enumerate((xx, yy, zz, xy)):
        found[:, column] = values
    return found
