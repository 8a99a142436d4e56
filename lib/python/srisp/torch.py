# SPDX-License-Identifier: Apache-2.0
"""RAW-like images from any image dataset of PyTorch, made as they are loaded."""

import os
import random
from typing import Any, Callable, Optional, Sequence, Union

import numpy
import torch

from . import _core, add_noise, mosaic, unprocess

_Path = Union[str, "os.PathLike[str]"]


class UnprocessDataset(torch.utils.data.Dataset):
    """The items of a dataset with their photos unprocessed.

        dataset = UnprocessDataset(ImageFolder("photos/"), glob.glob("refs/*.dng"), seed=1)
        loader = DataLoader(dataset, batch_size=8, num_workers=2, shuffle=True)
        for epoch in range(10):
            dataset.set_epoch(epoch)

    dataset: map-style. An item is a photo, or a tuple that begins with one: a path, a PIL image, an array height x width
        x 3, or a tensor 3 x height x width of uint8 or of floats of 0 to 1.
    references: srisp.Reference or paths; each item gets one at random. Paths are loaded when they are first needed, once
        per worker.
    brightness: EV for all, "sample" (each item's is drawn from what the model says of its own error), or None.
    noise: "reference" (of the item's reference), a srisp.NoiseModel, or None. cfa_pattern: of a mosaic, "RGGB", ... or
        "reference"; None: three channels.
    model: name or path. transform: of the finished tensor.
    seed, set_epoch(): with the item's index they say all random choices; workers and their number do not matter.

    Items are tensors, float32, 3 x height x width (1 x height x width as a mosaic), or tuples that begin with one. Each
    worker computes with its own thread. Works with workers that are forked or spawned.
    """

    def __init__(self, dataset: Any, references: Sequence[Union[_core.Reference, _Path]], *, model: _Path = "default",
                 brightness: Union[float, str, None] = "sample", noise: Union[_core.NoiseModel, str, None] = None,
                 cfa_pattern: Optional[str] = None, seed: int = 0,
                 transform: Optional[Callable[[torch.Tensor], torch.Tensor]] = None) -> None:
        if len(references) == 0:
            raise ValueError("references is empty: one or more are needed")
        if isinstance(noise, str) and noise != "reference":
            raise ValueError(f"noise is '{noise}': 'reference', a srisp.NoiseModel or None is needed")
        self.dataset, self.references = dataset, list(references)
        self.model, self.brightness, self.noise, self.cfa_pattern = model, brightness, noise, cfa_pattern
        self.seed, self.transform = seed, transform
        # In shared memory, so that workers that live on learn of it.
        self._epoch = torch.zeros((), dtype=torch.int64)
        self._epoch.share_memory_()
        self._noise: "dict[int, _core.NoiseModel]" = {}

    def set_epoch(self, epoch: int) -> None:
        """Other random choices for each epoch; workers that live on learn of it."""
        self._epoch.fill_(epoch)

    def __len__(self) -> int:
        return len(self.dataset)

    def __getitem__(self, index: int) -> Any:
        item = self.dataset[index]
        photo, rest = (item[0], tuple(item[1:])) if isinstance(item, (tuple, list)) else (item, None)
        draw = random.Random(f"{self.seed}:{int(self._epoch)}:{index}")
        which, seed = draw.randrange(len(self.references)), draw.getrandbits(32)
        reference = self._reference(which)
        raw = unprocess(_channels_last(photo), reference, model=self.model, brightness=self.brightness, seed=seed,
                        name=str(index), threads=1)
        if self.cfa_pattern is not None:
            raw = mosaic(raw, self.cfa_pattern, threads=1)
        if self.noise is not None:
            figures = self._reference_noise(which) if isinstance(self.noise, str) else self.noise
            raw = add_noise(raw, figures, seed, threads=1)
        array = numpy.asarray(raw)
        tensor = torch.from_numpy(array[None] if array.ndim == 2 else numpy.ascontiguousarray(array.transpose(2, 0, 1)))
        if self.transform is not None:
            tensor = self.transform(tensor)
        return tensor if rest is None else (tensor, *rest)

    def _reference(self, which: int) -> _core.Reference:
        reference = self.references[which]
        if not isinstance(reference, _core.Reference):
            reference = self.references[which] = _core.Reference(reference)
        return reference

    def _reference_noise(self, which: int) -> _core.NoiseModel:
        if which not in self._noise:
            self._noise[which] = self._reference(which).noise
        return self._noise[which]


def _channels_last(photo: Any) -> Any:
    if isinstance(photo, torch.Tensor) and photo.ndim == 3 and photo.shape[0] in (1, 3, 4):
        return photo.permute(1, 2, 0)
    return photo
