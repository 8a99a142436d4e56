# SPDX-License-Identifier: Apache-2.0
"""A user's program as mypy sees it (test_package.py); never run."""
import numpy

import srisp


def make(path: str) -> float:
    reference = srisp.Reference("ref.dng")
    raw = srisp.unprocess(path, reference, brightness=0.5, threads=2)
    noisy = srisp.add_noise(srisp.mosaic(raw, "RGGB"), reference.noise, seed=1)
    srisp.write_dng("photo.dng", noisy, reference, raw.parameters)
    total: numpy.float32 = raw.max()
    parameters = raw.parameters
    return float(total) if parameters is None else parameters.gain + srisp.psnr(raw, srisp.process(raw))
