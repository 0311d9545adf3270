"""Run time against error, growth of cost and what skips save, each measured in one process."""
