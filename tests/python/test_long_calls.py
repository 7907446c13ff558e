"""While the library works other threads go on, Ctrl-C ends it, progress is told, and memory does not grow."""

import gc
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import condyle

GRID = {"flexion": (0, 120, 4)}, {"adduction": (-40, 40, 4)}


def test_other_threads_advance_while_a_map_runs(hip):
    rom = hip.range_of_motion([])
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    rom.map(*GRID)
    advanced = counted[0] - before
    stop.set()
    thread.join()
    assert advanced >= 3


def test_many_threads_get_the_answers_of_one(hip):
    poses = hip.pose(flexion_deg=np.linspace(100, 150, 40))
    expected = [hip.penetration(pose).max_depth_mm for pose in poses]
    table = condyle.RadialTable(hip.fixed)
    gaps = table.query(hip.mobile.vertices).gap_mm
    wrong = []

    def ask():
        for pose, depth in zip(poses, expected):
            if hip.penetration(pose).max_depth_mm != depth or len(hip.pairs(pose)) == 0 and depth > 1:
                wrong.append(pose)
            table.update(hip.fixed.vertices)
            if not np.array_equal(table.query(hip.mobile.vertices).gap_mm, gaps):
                wrong.append(pose)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@pytest.mark.parametrize("call", [
    "joint.range_of_motion([]).map({'flexion': (0, 120, 0.5)}, {'adduction': (-40, 40, 0.5)})",
    "joint.range_of_motion().bands(samples=100000)",
    "joint.penetration(np.tile(joint.pose(flexion_deg=140), (3000000, 1, 1)))",
    "joint.pairs(np.tile(joint.pose(flexion_deg=145), (300000, 1, 1)))",
    "joint.recorded_contact(np.arange(200001), joint.pose(flexion_deg=np.arange(200001) % 2 + 138))",
], ids=["map", "bands", "penetration", "pairs", "recorded"])
def test_ctrl_c_ends_a_long_call(call, tmp_path):
    script = ("import condyle, numpy as np, os, signal, threading, time\n"
              "bones = condyle.sample_hip()\n"
              "joint = condyle.Joint(bones.hip_bone, bones.femur)\n"
              "joint.penetration(joint.pose(flexion_deg=140)); joint.pairs(joint.pose())\n"
              "at = []\n"
              "def interrupt():\n"
              "    at.append(time.perf_counter()); os.kill(os.getpid(), signal.SIGINT)\n"
              "threading.Timer(1.5, interrupt).start()\n"
              f"try:\n    {call}\n"
              "except KeyboardInterrupt:\n    print('interrupted after', time.perf_counter() - at[0])\n")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0 and done.stdout.startswith("interrupted after"), done.stdout + done.stderr


def test_what_a_callback_raises_ends_the_call(hip):
    class Enough(Exception):
        pass

    def progress(done, total):
        raise Enough

    with pytest.raises(Enough):
        hip.range_of_motion([]).map(*GRID, progress=progress)
    with pytest.raises(Enough):
        hip.penetration(np.tile(np.eye(4), (100, 1, 1)), progress=progress)


def test_progress_ends_with_all_done(hip):
    seen = []
    hip.penetration(np.tile(np.eye(4), (100, 1, 1)), progress=lambda *now: seen.append(now))
    assert seen[-1] == (100, 100) and seen == sorted(seen)


def resident_bytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc to read memory from")
@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the address sanitizer keeps what was freed")
def test_memory_does_not_grow_over_ten_thousand_calls():
    bones = condyle.sample_hip(scenario=1)
    joint = condyle.Joint(bones.hip_bone, bones.femur)
    pose, table = joint.pose(flexion_deg=145), condyle.RadialTable(bones.hip_bone)
    points = np.array(bones.femur.vertices[:50])

    def calls(count):
        for _ in range(count):
            joint.penetration(pose)
            table.query(points)
            condyle.TriMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
            try:
                joint.penetration(np.zeros((4, 4)))
            except condyle.UsageError:
                pass

    calls(2500)
    gc.collect()
    before = resident_bytes()
    calls(10_000)
    gc.collect()
    assert resident_bytes() - before < 1_000_000
