#!/usr/bin/env python3
# Results of one run or several as one table of pandas, with their units (Debian's python3-h5py and python3-pandas):
#   python3 examples/read_results.py out/soft_wall other/soft_wall
import sys
import h5py
import pandas


def read(folder):
    with h5py.File(f"{folder}/results.h5") as file:
        columns = {name: column.asstr()[:] if column.dtype.kind == "S" else column[:] for name, column in file["rows"].items()}
        units = {name: column.attrs["unit"].decode() for name, column in file["rows"].items()}
    rows = pandas.DataFrame(columns)
    return rows[rows.status == "finished"].assign(run=folder), units


parts, units = zip(*(read(folder) for folder in sys.argv[1:]))
rows = pandas.concat(parts).drop_duplicates("scene_hash")  # a scene of two runs is one impact
print(f"{len(rows)} impacts of {len(parts)} runs; vn in {units[0]['vn']}")
print(rows.groupby("over_psi1" if "over_psi1" in rows else "psi1").e.agg(["mean", "sem", "count"]))
