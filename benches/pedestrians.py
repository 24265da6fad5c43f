#!/usr/bin/env python3
"""Pedestrian-steps per second of processors of motes and JuPedSim, by the collision-free speed model from the same start on the same cores.

    python3 benches/pedestrians.py --motes target/release/motes --json pedestrians.json

makes a virtual environment in a temporary folder, installs jupedsim into it, and measures there; with --here, what the
running Python has installed. Nothing else should run meanwhile; how much did is printed. For Linux.

Pedestrians of radius 0.2 m stand on a square grid of 1 m, moved at random by up to 0.2 m along each axis, in an open room (a square whose walls are
50 m away and, in motes, no plan), and walk to a point 40 m to the right of the crowd, at desired speeds of 1.2 m/s, with all other parameters as
JuPedSim has them by default, in steps of 0.01 s.

What is timed: whole steps, the same ones in both: --steps of them after --warm that do not count. In motes they are the
difference of runs with and without them; in JuPedSim, that of `iterate`. Seconds are those of processors, of all threads
together: JuPedSim has one thread, motes one for each core. Both take turns --repeat times; numbers are medians, and `ratio` is the
median of the ratios of the same turn, motes to JuPedSim: above 1 motes does more steps with a second of a processor.
`apart`: how far places after the last step are from those of JuPedSim, at most [m]: both computed the same.
What differs: motes computes in f32, JuPedSim in f64. JuPedSim looks for its way round walls in each step, of which there are four.
"""

import argparse
import json
import os
import random
import resource
import shutil
import statistics
import subprocess
import sys
import time
from importlib import metadata
from pathlib import Path
from tempfile import TemporaryDirectory

import elsewhere

SCENE = """
[simulation]
integrator = "symplectic_euler"
dt = 0.01
steps = 1
[box]
size = [{size}, {size}, 0]
low = [-60, -60, 0]
boundary = "open"
[[particles]]
file = "start.csv"
[[force]]
kind = "walk"
to = "target"
target = [{target}, {middle}, 0]
[[force]]
kind = "collision_free_speed"
over = "{over}"
[output]
every = 1
formats = ["csv"]
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--motes", default="target/release/motes", help="the program [%(default)s]")
    parser.add_argument("--sides", type=int, nargs="+", default=[32, 100], help="pedestrians along a side [32 100]")
    parser.add_argument("--repeat", type=int, default=5, help="turns; medians count [%(default)s]")
    parser.add_argument("--warm", type=int, default=20, help="steps before those that count [%(default)s]")
    parser.add_argument("--steps", type=int, default=100, help="steps that count [%(default)s]")
    parser.add_argument("--json", metavar="FILE", help="write the result here, too")
    parser.add_argument("--here", action="store_true", help="use the packages that this Python has installed")
    return parser.parse_args()


def worked():
    """Seconds of processors for this script and what it has started and seen end."""
    return sum(sum(resource.getrusage(part)[:2]) for part in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def busy():
    """Seconds of processors for all else."""
    ticks = [int(word) for word in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:8]]
    return sum(ticks[:3] + ticks[5:7]) / os.sysconf("SC_CLK_TCK") - worked()


class Case:
    def __init__(self, args, folder, side):
        self.args, self.folder, self.side = args, folder, side
        self.target, self.middle = side + 40.0, 0.5 * side
        dice = random.Random(side)
        # Multiples of 2⁻¹⁰ are the same in single precision.
        place = lambda n: n + round(1024 * dice.uniform(-0.2, 0.2)) / 1024
        self.places = [(place(i), place(j)) for i in range(side) for j in range(side)]
        rows = "".join(f"{x!r},{y!r},0,80,0.2,1.2\n" for x, y in self.places)
        (folder / "start.csv").write_text("x,y,z,mass,radius,desired_speed\n" + rows)

    def motes(self, over):
        """Seconds of processors and by the clock for the steps that count, and places after the last of them."""
        scene = self.folder / f"{over}.toml"
        scene.write_text(SCENE.format(size=self.side + 220.0, target=self.target, middle=self.middle, over=over))
        seen = []
        for steps in (self.args.warm, self.args.warm + self.args.steps):
            out = self.folder / "out"
            command = [str(Path(self.args.motes).resolve()), "run", scene, "-o", out, "--overwrite", "--json",
                       "--steps", str(steps), "--set", f"output.every={steps}"]
            before = worked()
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(f"motes ended with {done.returncode}: {done.stdout[-800:]}{done.stderr[-800:]}")
            events = [json.loads(line) for line in done.stdout.splitlines()]
            self.device = next(event["device"] for event in events if event["event"] == "start")
            clock = next(event["stepping_seconds"] for event in events if event["event"] == "finish")
            seen.append((worked() - before, clock))
        table = sorted(out.glob("*.csv"), key=lambda path: path.stat().st_size)[-1]
        head, *rows = table.read_text().splitlines()
        x, y = (head.split(",").index(name) for name in "xy")
        rows = [row.split(",") for row in rows[-len(self.places):]]
        places = [(float(row[x]), float(row[y])) for row in rows]
        return *(after - before for before, after in zip(*seen)), places

    def jupedsim(self):
        import jupedsim
        import shapely
        low, high = -60.0, self.side + 60.0
        model = jupedsim.CollisionFreeSpeedModel()
        area = shapely.box(low, low, high + 50.0, high)
        simulation = jupedsim.Simulation(model=model, geometry=area, dt=0.01)
        stage = simulation.add_waypoint_stage((self.target, self.middle), 0.001)
        journey = simulation.add_journey(jupedsim.JourneyDescription([stage]))
        ids = [simulation.add_agent(jupedsim.CollisionFreeSpeedModelAgentParameters(
            position=place, desired_speed=1.2, radius=0.2, time_gap=1.0, journey_id=journey, stage_id=stage))
            for place in self.places]
        simulation.iterate(self.args.warm)
        before, clock = worked(), time.perf_counter()
        simulation.iterate(self.args.steps)
        seconds = (worked() - before, time.perf_counter() - clock)
        return *seconds, [simulation.agent(i).position for i in ids]


def measured(args, side):
    with TemporaryDirectory() as folder:
        case = Case(args, Path(folder), side)
        programs = {"motes, near": lambda: case.motes("near"), "motes, list": lambda: case.motes("list"),
                    "JuPedSim": case.jupedsim}
        turns = {name: [] for name in programs}
        apart = 0.0
        before, start = busy(), time.perf_counter()
        for turn in range(args.repeat):
            places = {}
            for name, run in programs.items():
                processor, clock, places[name] = run()
                turns[name].append((processor, clock))
            for name in programs:
                pairs = zip(places[name], places["JuPedSim"])
                apart = max(apart, max(max(abs(a - c), abs(b - d)) for (a, b), (c, d) in pairs))
        others = (busy() - before) / (time.perf_counter() - start)
        count = len(case.places)
        result = {"count": count, "device": case.device, "apart": apart, "busy_cores_beside": others, "programs": {}}
        print(f"\n{count} pedestrians, {case.device}: apart by {apart:.1e} m; {others:.2f} cores busy with other things")
        for name, seen in turns.items():
            rate = [args.steps * count / processor for processor, _ in seen]
            by_clock = [args.steps * count / clock for _, clock in seen]
            ratio = [peer[0] / own[0] for own, peer in zip(seen, turns["JuPedSim"])]
            one = {"per_processor_second": statistics.median(rate), "per_second": statistics.median(by_clock),
                   "ratio": statistics.median(ratio), "turns": seen}
            result["programs"][name] = one
            print(f"{name:12} {one['per_processor_second']:.3g} pedestrian-steps per second of a processor, "
                  f"{one['per_second']:.3g} per second, ratio {one['ratio']:.2f}")
        return result


def main():
    args = arguments()
    if shutil.which(args.motes) is None:
        raise SystemExit(f"there is no program {args.motes}: say by --motes where it is")
    if not args.here:
        return elsewhere.rerun(["jupedsim"])
    version = subprocess.run([args.motes, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    peer = metadata.version("jupedsim")
    print(f"{version}; JuPedSim {peer}; {args.repeat} turns of {args.steps} steps")
    result = {"motes": version, "jupedsim": peer, "cores": len(os.sched_getaffinity(0)), "repeat": args.repeat,
              "warm": args.warm, "steps": args.steps, "cases": [measured(args, side) for side in args.sides]}
    if args.json:
        Path(args.json).write_text(json.dumps(result, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
