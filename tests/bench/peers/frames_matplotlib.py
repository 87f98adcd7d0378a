"""Draws the mesh that `frames DIR` wrote as matplotlib users do, PNG included: tripcolor of node values, springs as a LineCollection. Prints frames a second."""
import sys
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

folder, out = sys.argv[1], sys.argv[2]
triangles = np.loadtxt(f"{folder}/triangles.txt", dtype=int)
springs = np.loadtxt(f"{folder}/springs.txt", dtype=int)
values = np.loadtxt(f"{folder}/values.txt")
places = np.loadtxt(f"{folder}/places.txt").reshape(-1, len(values), 2)

figure = plt.figure(figsize=(12.8, 7.2), dpi=100)
times = []
for k, place in enumerate(places[:12]):
    start = time.perf_counter()
    figure.clf()
    axes = figure.add_axes([0.02, 0.02, 0.86, 0.9])
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_xlim(-4.2, 4.2)
    axes.set_ylim(-2.2, 2.4)
    drawn = axes.tripcolor(place[:, 0], place[:, 1], triangles, values, shading="gouraud", cmap="YlGnBu", vmin=0, vmax=values.max())
    axes.add_collection(LineCollection(place[springs], colors=(0.1, 0.1, 0.2, 0.35), linewidths=0.5))
    figure.colorbar(drawn, ax=axes)
    figure.suptitle(f"t = {k}")
    figure.savefig(f"{out}/matplotlib_{k:03}.png", pil_kwargs={"compress_level": 1})
    times.append(time.perf_counter() - start)
times = sorted(times[1:])
print(f"matplotlib {matplotlib.__version__}: {1 / times[0]:.2f} frames a second at best, {1 / times[len(times) // 2]:.2f} in the median")
