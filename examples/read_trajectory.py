#!/usr/bin/python3
"""Reads the trajectory of a run folder: frames, mean heights and where the walls are.

usage: read_trajectory.py RUN_FOLDER        (needs h5py and numpy; all lengths in lattice spacings)
"""
import sys
import h5py
import numpy

FLOOR = -2**31  # in contacts/other

with h5py.File(sys.argv[1] + "/trajectory.h5", "r") as file:
    stages = [name.decode() for name in file["scene/stages"]]
    walls = [name.decode() for name in file["scene/walls/name"]]
    sites = file["scene/kinds/size"][:]  # of each kind: what a particle weighs
    frames = {name: column[:] for name, column in file["frames"].items()}
    for frame, step in enumerate(frames["step"]):
        rows = slice(frames["first"][frame], frames["first"][frame] + frames["particles"][frame])
        weight = sites[file["particles/kind"][rows]]
        y = file["particles/position"][rows, 1]
        height = numpy.average(y, weights=weight) if len(y) else 0.0
        print(step, stages[frames["stage"][frame]], len(y), f"{height:.9g}", end="")
        for wall, name in enumerate(walls):
            if file["walls/present"][frame, wall]:
                x, y = file["walls/position"][frame, wall]
                print(f" {name}=({x:.9g},{y:.9g})", end="")
        if "contacts" in file:
            rows = slice(frames["first_contact"][frame], frames["first_contact"][frame] + frames["contacts"][frame])
            on_floor = file["contacts/other"][rows] == FLOOR
            print(f" floor={file['contacts/force'][rows, 0][on_floor].sum():.9g}", end="")
        print()
