"""Draws the masses of a snapshot with yt, seen along z: yt_galaxy.py SNAPSHOT PICTURE"""

import sys

import yt

snapshot, picture = sys.argv[1:]
data = yt.load(
    snapshot,
    bounding_box=[[-4.0, 4.0]] * 3,
    unit_base={"length": (1, "kpc"), "mass": (1e10, "Msun"), "velocity": (1, "km/s")},
)
data.index  # Types are known once it is there.
kind = data.particle_types_raw[0]
plot = yt.ParticlePlot(data, (kind, "particle_position_x"), (kind, "particle_position_y"), (kind, "Masses"))
plot.set_buff_size(160)
plot.set_figure_size(6)
plot.save(picture)
