"""While the library works other threads go on, Ctrl-C ends it, progress is reported, and memory does not grow."""

import gc
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from common import at_once

import condyle

GRID = {"flexion": (0, 120, 4)}, {"adduction": (-40, 40, 4)}


def advanced_during_a_map(rom):
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    rom.map(*GRID)
    advanced = counted[0] - before
    stop.set()
    thread.join()
    return advanced


def test_other_threads_advance_while_a_map_runs(hip):
    # Were the lock held, another thread would get it at most once between the reading of the count and the map.
    rom = hip.range_of_motion([])
    assert any(advanced_during_a_map(rom) >= 3 for _ in range(20))


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

    at_once(4, ask)
    assert not wrong


# Each takes many times as long as the wait for the signal.
INTERRUPTED = """
import os, signal, threading
import numpy as np
import condyle

bones = condyle.sample_hip()
joint = condyle.Joint(*bones)
rom = joint.range_of_motion([])
deep = np.tile(joint.pose(flexion_deg=145), (200_000, 1, 1))
moving = joint.pose(flexion_deg=np.arange(200_001) % 2 + 138)
contact = condyle.ElasticContact(joint.fixed, joint.mobile, mobile_layer=condyle.ElasticLayer(12, 0.42, 1.65))
own = [condyle.Motion("mine", "flexion", 170, {"adduction": n * 1e-3}) for n in range(20_000)]

calls = {
    "map": lambda progress: rom.map({"flexion": (0, 120, 0.5)}, {"adduction": (-40, 40, 0.5)}, progress=progress),
    "bands": lambda progress: joint.range_of_motion().bands(samples=100_000, progress=progress),
    "penetration": lambda progress: joint.penetration(deep, progress=progress),
    "pairs": lambda progress: joint.pairs(deep, progress=progress),
    "recorded": lambda progress: joint.recorded_contact(np.arange(200_001), moving, progress=progress),
    "normal": lambda progress: joint.normal_contact(deep[:20_000], progress=progress),
    "along": lambda progress: joint.contact_along(deep[:20_000], progress=progress),
    "pressure": lambda progress: contact.at(deep[:20_000], progress=progress),
    "zones": lambda progress: rom.zones(own, progress=progress),
    "depths": lambda progress: condyle.DepthRange(joint, 1.0).limits(own, progress=progress),
}
without_progress = {
    "limits": lambda _: joint.range_of_motion(own),
    "hip": lambda _: condyle.sample_hip(triangles=(4_000_000, 4_000_000)),
    "cartilages": lambda _: condyle.sample_cartilages(triangles=(4_000_000, 4_000_000)),
}
for name, call in {**calls, **without_progress}.items():
    seen = []
    def progress(done, total):
        # Sent while the library works, not while this runs: that would be an exception of the callback.
        # On a loaded machine it comes while the timer starts: what was done is known by then.
        seen.append((done, total))
        if len(seen) == 1:
            threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGINT)).start()
    if name in without_progress:
        seen.append((0, 1))
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        call(progress)
        print(name, "came to its end")
    except KeyboardInterrupt:
        print(name, "interrupted" if seen[-1][0] < seen[-1][1] else "at its end")
"""


def test_ctrl_c_ends_long_calls():
    done = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, timeout=600)
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and len(lines) == 13, done.stdout + done.stderr
    assert all(line.endswith(" interrupted") for line in lines), done.stdout


def test_what_a_callback_raises_ends_the_call(hip):
    class Enough(Exception):
        pass

    def progress(done, total):
        raise Enough

    for ask in (lambda: hip.range_of_motion([]).map(*GRID, progress=progress),
                lambda: hip.penetration(np.tile(np.eye(4), (100, 1, 1)), progress=progress)):
        with pytest.raises(Enough):
            ask()


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
    joint = condyle.Joint(*bones)
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

    def growth():
        gc.collect()
        before = resident_bytes()
        calls(10_000)
        gc.collect()
        return resident_bytes() - before

    calls(2500)
    # A leak grows each time; other memory growth comes once.
    assert any(growth() < 1_000_000 for _ in range(4))
