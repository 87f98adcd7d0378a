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
        axes = [name for name, column in file["rows"].items() if column.attrs["doc"] == b"parameter of the sweep"]
    rows = pandas.DataFrame(columns)
    return rows[rows.status == "finished"].assign(run=folder), units, axes


parts, units, axes = zip(*(read(folder) for folder in sys.argv[1:]))
for other in units:
    for name in other.keys() & units[0].keys():
        if other[name] != units[0][name]:
            sys.exit(f"{name} is in '{units[0][name]}' and in '{other[name]}'; join runs of the same units")
# A scene of two runs is one impact, with the parameters of both; a parameter that a run has not is left empty (NaN).
rows = pandas.concat(parts).groupby("scene_hash", sort=False).first().reset_index()
print(f"{len(rows)} impacts of {len(parts)} runs; vn in {units[0]['vn']}")
samples = ("sample", "seed", "mirrored", "pair")
by = [name for name in dict.fromkeys(sum(axes, [])) if not name.endswith(samples) and rows[name].nunique(dropna=False) > 1]
print((rows.groupby(by, dropna=False) if by else rows.groupby("status")).e.agg(["mean", "sem", "count"]))
