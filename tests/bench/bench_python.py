#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What Python costs: ratios measured in one run. Not a test.

    PYTHONPATH=build/python bench_python.py BUILD PHOTO REFERENCE
"""
import json
import statistics
import subprocess
import sys
import tempfile
import time

import numpy
import srisp
from PIL import Image

ROUNDS, CALLS = 5, 40


def milliseconds(work):
    start = time.perf_counter()
    work()
    return (time.perf_counter() - start) * 1e3


def line(name, value, unit, target, detail):
    print(f"{name:16} {value:9.4g} {unit:18} {target:9} {detail}", flush=True)


def import_time(build):
    """Of the import alone, in new processes: with what is on disk in the cache."""
    program = "import time; t = time.perf_counter(); import srisp; print((time.perf_counter() - t) * 1e3)"
    use = "import time; t = time.perf_counter(); import srisp; srisp.Model; print((time.perf_counter() - t) * 1e3)"
    numpy_alone = "import time; t = time.perf_counter(); import numpy; print((time.perf_counter() - t) * 1e3)"
    times = {text: statistics.median(float(subprocess.check_output([sys.executable, "-c", text])) for _ in range(9))
             for text in (program, use, numpy_alone)}
    line("import", times[program], "ms", "<= 60", f"import srisp; the first use loads the library, {times[use]:.0f} ms in all; "
         f"import numpy: {times[numpy_alone]:.0f} ms")


def one_call(build, photo, reference_path):
    """The C++ call and Python's in turns."""
    pixels = numpy.asarray(Image.open(photo).resize((640, 480)))
    reference = srisp.Reference(reference_path)
    srisp.unprocess(pixels, reference)
    ours, theirs = [], []
    for _ in range(ROUNDS):
        ours.append(statistics.median(milliseconds(lambda: srisp.unprocess(pixels, reference)) for _ in range(CALLS)))
        output = subprocess.check_output([f"{build}/bin/srispbench", "in_memory", "--photo", photo, "--reference", reference_path,
                                          "--json"])
        theirs.append(json.loads(output)["in_memory"]["value"])
    line("call", min(ours) / min(theirs), "of the C++ call", "<= 1.05", f"unprocess() of a 640 x 480 array; base: "
         f"{min(theirs):.1f} ms; rounds: {', '.join(f'{a / b:.3f}' for a, b in zip(ours, theirs))}")


class Photos:
    """JPEG files, as arrays."""

    def __init__(self, path, count):
        self.path, self.count = path, count

    def __len__(self):
        return self.count

    def __getitem__(self, index):
        return numpy.asarray(Image.open(self.path).convert("RGB"))


class Tensors:
    """What a loader without srisp would do."""

    def __init__(self, photos):
        self.photos = photos

    def __len__(self):
        return len(self.photos)

    def __getitem__(self, index):
        import torch
        return torch.from_numpy(self.photos[index].transpose(2, 0, 1).astype(numpy.float32) / 255)


def loader(photo, reference_path):
    import torch
    from srisp.torch import UnprocessDataset
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/small.jpg"
        Image.open(photo).resize((640, 480)).save(path, quality=90)
        photos = Photos(path, 200)

        def rate(dataset):
            batches = iter(torch.utils.data.DataLoader(dataset, batch_size=4, num_workers=2))
            next(batches)  # the workers have started
            start = time.perf_counter()
            count = sum(len(batch) for batch in batches)
            return count / (time.perf_counter() - start)

        rates = [(rate(UnprocessDataset(photos, [reference_path])), rate(Tensors(photos))) for _ in range(3)]
        best, decoding = max(a for a, _ in rates), max(b for _, b in rates)
        line("loader", best / decoding, "of decoding", ">= 0.5", f"UnprocessDataset with two workers, JPEGs of 640 x 480: {best:.0f} "
             f"images/s; base: decoding and floats alone, {decoding:.0f} images/s")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    import_time(sys.argv[1])
    one_call(*sys.argv[1:])
    loader(*sys.argv[2:])
