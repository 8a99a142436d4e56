# SPDX-License-Identifier: Apache-2.0
"""Threads, processes and signals, and what is left behind."""
import concurrent.futures
import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy
import pytest
import srisp
from conftest import same_bits


def test_threads_give_the_same_bits(photo, reference, raw):
    others = [numpy.roll(photo, shift, axis=0) for shift in range(4)]
    expected = [srisp.unprocess(image, reference, threads=1) for image in others]
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda i: srisp.unprocess(others[i % 4], reference), range(64)))
    for i, result in enumerate(results):
        same_bits(result, expected[i % 4])


def test_the_lock_is_released(reference):
    image = numpy.zeros((3000, 4000, 3), numpy.uint8)
    count, done = 0, threading.Event()

    def work():
        srisp.unprocess(image, reference)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        count += 1
        time.sleep(0.001)
    thread.join()
    assert count > 20


def unprocess_in_child(image, reference, queue):
    queue.put(numpy.asarray(srisp.unprocess(image, reference)))


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_processes_give_the_same_bits(photo, reference, raw, method):
    """After the parent's threads have been at work."""
    context = multiprocessing.get_context(method)
    queue = context.Queue()
    children = [context.Process(target=unprocess_in_child, args=(photo, reference, queue)) for _ in range(3)]
    for child in children:
        child.start()
    for _ in children:
        same_bits(queue.get(timeout=60), raw)
    for child in children:
        child.join(30)
        assert child.exitcode == 0


def read_in_child(path, reference, queue):
    queue.put(numpy.asarray(srisp.unprocess(path, reference, input="srgb")))


def test_forked_children_read_files_of_all_kinds(raw, photo_path, reference, tmp_path):
    """OpenEXR has threads of its own."""
    context = multiprocessing.get_context("fork")
    raw.save(tmp_path / "raw.exr", "float")
    raw.save(tmp_path / "raw.tif")
    for path in (photo_path, tmp_path / "raw.exr", tmp_path / "raw.tif"):
        expected = srisp.unprocess(path, reference, input="srgb")
        queue = context.Queue()
        child = context.Process(target=read_in_child, args=(path, reference, queue))
        child.start()
        same_bits(queue.get(timeout=60), expected)
        child.join(30)
        assert child.exitcode == 0


def test_forks_while_threads_are_at_work_do_not_hang(photo, photo_path, reference, raw, tmp_path):
    stop = threading.Event()
    raw.save(tmp_path / "raw.exr", "float")

    def work(image):
        while not stop.is_set():
            srisp.unprocess(image, reference, input="srgb")

    threads = [threading.Thread(target=work, args=(image,)) for image in (photo, photo_path, tmp_path / "raw.exr")]
    for thread in threads:
        thread.start()
    context = multiprocessing.get_context("fork")
    try:
        for _ in range(20):
            queue = context.Queue()
            child = context.Process(target=unprocess_in_child, args=(photo, reference, queue))
            child.start()
            same_bits(queue.get(timeout=60), raw)
            child.join(30)
    finally:
        stop.set()
        for thread in threads:
            thread.join()


WORK = """
import os, signal, sys, threading, time
import numpy, srisp
reference = srisp.Reference(sys.argv[1])
image = numpy.random.default_rng(1).integers(0, 255, (6000, 8000, 3), numpy.uint8)
floats = image.astype(numpy.float32) / numpy.float32(255) if "floats" in sys.argv[3] else None
parameters = srisp.unprocess(image[:100, :100], reference).parameters
sent = []
def send():
    time.sleep(float(sys.argv[2]))
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
sender = threading.Thread(target=send)
sender.start()
try:
    {call}
    sender.join()
    time.sleep(0.2)
    print("finished")
except KeyboardInterrupt:
    print(f"{{time.monotonic() - sent[0]:.3f}}")
assert srisp.unprocess(image[:100, :100], reference).shape == (100, 100, 3)
"""


@pytest.mark.parametrize("call, after", [
    ("srisp.unprocess(image, reference)", 0.02), ("srisp.unprocess(image, reference)", 0.5),
    ("srisp.unprocess(floats, reference)", 0.3), ("srisp.process(floats, parameters)", 0.3),
    ("srisp.apply(image, parameters)", 0.3), ("srisp.apply(floats, parameters)", 0.3),
    ("srisp.thumbnail(image)", 0.1)])
def test_ctrl_c_is_answered_at_once(reference_path, call, after):
    times = []
    for _ in range(5):  # the machine may be busy: the quickest counts
        run = subprocess.run([sys.executable, "-c", WORK.format(call=call), reference_path, str(after), call], text=True,
                             stdout=subprocess.PIPE, timeout=120, check=True)
        times.append(run.stdout.strip())
        if times[-1] == "finished" or float(times[-1]) < 0.2:
            break
    assert times[-1] == "finished" and call == "srisp.thumbnail(image)" or float(times[-1]) < 0.2, times


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_ten_thousand_calls_leave_nothing(photo, reference, tmp_path):
    small = numpy.ascontiguousarray(photo[:16, :16])
    parameters = srisp.select(small, reference)
    image = srisp.unprocess(small, parameters=parameters)

    def calls(count):
        for _ in range(count):
            raw = srisp.unprocess(small, parameters=parameters, threads=1)
            srisp.apply(raw, raw.parameters, direction="forward", threads=1)
            reference.thumbnail, reference.facts.color_matrices  # noqa: B018
            parameters.to_dict(), parameters.color, repr(parameters)  # noqa: B018
            for wrong in (small[..., :2].astype(int), None):
                try:
                    srisp.unprocess(wrong, reference)
                except TypeError:
                    pass
            try:
                srisp.Parameters.from_json("{}")
            except srisp.Error:
                pass

    calls(200)
    gc.collect()
    objects, before = len(gc.get_objects()), resident_bytes()
    counts = [sys.getrefcount(thing) for thing in (small, reference, parameters, image)]
    calls(2500)  # of some five functions
    gc.collect()
    assert [sys.getrefcount(thing) for thing in (small, reference, parameters, image)] == counts
    assert abs(len(gc.get_objects()) - objects) < 100
    assert resident_bytes() - before < 8 << 20


def test_arrays_are_let_go(photo, reference):
    class Array(numpy.ndarray):
        pass

    image = photo.copy().view(Array)
    import weakref
    gone = weakref.ref(image)
    result = srisp.unprocess(image, reference)
    del image
    gc.collect()
    assert gone() is None and result.shape == photo.shape


def test_a_program_that_ends_at_once_ends_well(reference_path):
    """Also while a thread of its own is still at work."""
    for program in ("import srisp; srisp.Model()", "import srisp",
                    "import srisp, threading, numpy, sys\n"
                    "r = srisp.Reference(sys.argv[1])\n"
                    "threading.Thread(target=lambda: srisp.unprocess(numpy.zeros((2000, 2000, 3), numpy.uint8), r), daemon=True).start()"):
        run = subprocess.run([sys.executable, "-c", program, reference_path], timeout=60, stderr=subprocess.PIPE, text=True)
        assert (run.returncode, run.stderr) == (0, "")
    at_work = ("import srisp, threading, numpy, sys, time\n"
               "reference, image = srisp.Reference(sys.argv[1]), numpy.zeros((1000, 1000, 3), numpy.uint8)\n"
               "def work():\n"
               "    while True: srisp.unprocess(image, srisp.Reference(sys.argv[1]))\n"
               "for i in range(3): threading.Thread(target=work, daemon=True).start()\n"
               "time.sleep(float(sys.argv[2]))\n"
               "import atexit; atexit.register(lambda: srisp.thumbnail(image))")
    for pause in (0.01, 0.1, 0.2, 0.3, 0.5):
        run = subprocess.run([sys.executable, "-c", at_work, reference_path, str(pause)], timeout=60, stderr=subprocess.PIPE, text=True)
        assert (run.returncode, run.stderr) == (0, "")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
