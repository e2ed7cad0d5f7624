"""Accuracy against time of a scene of your own, as a plot for a paper (.pdf, .png or .svg); in a notebook each part is a cell.

    efsat accuracy --scene scenes/gears.toml --out out
    python examples/accuracy_time.py out/points.csv plot.pdf
"""

# %% The points of the sweep that fit the device
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

source, target = sys.argv[1:]
with open(source, newline="") as file:
    rows = [row for row in csv.DictReader(file) if row["fits"] == "true"]
points = [(float(row["effective_ns"]), float(row["possibly_incorrect_share"]), row["method"], row["width"]) for row in rows]

# %% Those that no other point beats in both time and undecided pairs
front = []
for point in sorted(points):
    if not front or point[1] < front[-1][1]:
        front.append(point)

# %% The plot
figure, axes = plt.subplots(figsize=(6, 4))
for method, mark in [("axes", "o"), ("determinants", "D")]:
    own = [point for point in points if point[2] == method]
    axes.plot([point[0] for point in own], [100 * point[1] for point in own], mark, markersize=4, label=method)
axes.step([point[0] for point in front], [100 * point[1] for point in front], "k-", where="post", label="best")
for time, share, _, width in front:
    axes.annotate(f"{width} bits", (time, 100 * share), textcoords="offset points", xytext=(5, 5), fontsize=8)
axes.set(xscale="log", yscale="symlog", xlabel="effective time per pair, ns", ylabel="undecided pairs, %")
axes.set_yscale("symlog", linthresh=1e-3)
axes.legend()
figure.savefig(target, bbox_inches="tight")
