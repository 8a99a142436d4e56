# SPDX-License-Identifier: Apache-2.0
"""RAW-like images for PyTorch's loaders."""
import numpy
import pytest
import srisp
from conftest import SAMPLE, same_bits

torch = pytest.importorskip("torch")
from srisp.torch import UnprocessDataset  # noqa: E402

REFERENCE = str(SAMPLE / "reference.dng")


class Photos(torch.utils.data.Dataset):
    """Twelve crops of the sample with a label each, as tensors."""

    def __init__(self, kind="tensor"):
        self.kind = kind

    def __len__(self):
        return 12

    def __getitem__(self, index):
        if index >= 12:
            raise IndexError
        crop = photo_crop(index)
        return (torch.from_numpy(crop).permute(2, 0, 1) if self.kind == "tensor" else crop), index


def photo_crop(index):
    from PIL import Image
    return numpy.array(Image.open(SAMPLE / "photo.jpg").crop((20 * index, 5 * index, 20 * index + 96, 5 * index + 64)))


def batches(dataset, **keywords):
    loader = torch.utils.data.DataLoader(dataset, batch_size=4, **keywords)
    return [torch.cat(parts) for parts in zip(*loader)]


def test_items_are_unprocessed_with_their_labels():
    dataset = UnprocessDataset(Photos(), [REFERENCE], brightness=None)
    assert len(dataset) == 12
    tensor, label = dataset[3]
    assert tensor.shape == (3, 64, 96) and tensor.dtype == torch.float32 and label == 3
    same_bits(tensor.permute(1, 2, 0).numpy(), srisp.unprocess(photo_crop(3), REFERENCE))
    same_bits(UnprocessDataset(Photos("array"), [REFERENCE], brightness=None)[3][0].numpy(), tensor.numpy())


def test_photos_alone_and_paths_are_taken():
    assert UnprocessDataset([str(SAMPLE / "photo.jpg")], [REFERENCE])[0].shape == (3, 267, 400)
    doubled = UnprocessDataset([photo_crop(0)], [REFERENCE], transform=lambda tensor: tensor * 2)[0]
    same_bits(doubled.numpy(), UnprocessDataset([photo_crop(0)], [REFERENCE])[0].numpy() * 2)


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_workers_do_not_change_a_bit(context):
    references = [REFERENCE, srisp.Reference(REFERENCE)]
    keywords = {"seed": 3, "noise": "reference", "cfa_pattern": "RGGB"}
    images, labels = batches(UnprocessDataset(Photos(), references, **keywords))
    assert images.shape == (12, 1, 64, 96) and labels.tolist() == list(range(12))
    for workers in (1, 2):
        again, _ = batches(UnprocessDataset(Photos(), references, **keywords), num_workers=workers,
                           multiprocessing_context=context)
        same_bits(again.numpy(), images.numpy())


def test_seeds_and_epochs_choose():
    first = UnprocessDataset(Photos(), [REFERENCE], seed=1)
    means = {float(first[0][0].mean())}
    for epoch in (1, 2):
        first.set_epoch(epoch)
        means.add(float(first[0][0].mean()))
    means.add(float(UnprocessDataset(Photos(), [REFERENCE], seed=2)[0][0].mean()))
    assert len(means) == 4
    first.set_epoch(0)
    same_bits(first[0][0].numpy(), UnprocessDataset(Photos(), [REFERENCE], seed=1)[0][0].numpy())


def test_workers_that_live_on_learn_of_the_epoch():
    dataset = UnprocessDataset(Photos(), [REFERENCE], seed=1)
    loader = torch.utils.data.DataLoader(dataset, batch_size=12, num_workers=1, persistent_workers=True)
    first = next(iter(loader))[0]
    dataset.set_epoch(1)
    second = next(iter(loader))[0]
    assert not torch.equal(first, second)
    del loader


def test_all_references_are_used():
    names = []

    class Spy(UnprocessDataset):
        def _reference(self, which):
            names.append(which)
            return super()._reference(which)

    dataset = Spy(Photos(), [REFERENCE] * 3)
    for index in range(12):
        dataset[index]
    assert set(names) == {0, 1, 2}


def test_noise_of_a_model():
    clean = UnprocessDataset(Photos(), [REFERENCE], brightness=None)[0][0]
    noisy = UnprocessDataset(Photos(), [REFERENCE], brightness=None, noise=srisp.NoiseModel(0.01, 1e-4))[0][0]
    assert 0.01 < float((noisy - clean).std()) < 0.1


def test_wrong_arguments_are_named():
    with pytest.raises(ValueError, match="references is empty"):
        UnprocessDataset(Photos(), [])
    with pytest.raises(ValueError, match="noise is 'loud'"):
        UnprocessDataset(Photos(), [REFERENCE], noise="loud")
    with pytest.raises(srisp.Error, match="no.dng"):
        UnprocessDataset(Photos(), ["no.dng"])[0]
    with pytest.raises(IndexError):
        UnprocessDataset(Photos(), [REFERENCE])[12]
