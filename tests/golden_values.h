// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include "base/input_file.h"
#include "model/safetensors.h"
#include "shared_files.h"

/// What an independent implementation makes of a model: inputs, steps and outputs, by the names of golden.py.
struct GoldenValues {
    std::string model; ///< path of the model
    std::map<std::string, srisp::Tensor> values;

    void read(const std::string& path)
    {
        srisp::Expected<std::string> bytes = srisp::read_file(path, 1 << 26, path);
        REQUIRE_MESSAGE(bytes, (bytes ? "" : bytes.error().message));
        srisp::Expected<srisp::SafeTensors> file = srisp::parse_safetensors(*bytes, path);
        REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
        values.merge(file->tensors);
    }
    /// Of the running thumbnail after a block, `size` pixels a side, the files have every n-th row and column.
    int thumbnail_step(int size) const { return size / static_cast<int>(values.at("thumb.after_tone").shape[0]); }
};

/// Of a model that ships, by tests/golden/method.py.
inline GoldenValues shipped_golden_values(const std::string& name)
{
    const std::string source = SRISP_SOURCE_DIR;
    GoldenValues golden{ source + "/configs/models/" + name + ".safetensors", {} };
    golden.read(source + "/tests/golden/inputs.safetensors");
    golden.read(source + "/tests/golden/values_" + name + ".safetensors");
    return golden;
}

/// Of a model with random weights among the shared test data, by an implementation in PyTorch.
inline GoldenValues shared_golden_values(const std::string& name)
{
    GoldenValues golden{ shared_file("golden/model_" + name + ".safetensors"), {} };
    golden.read(shared_file("golden/values_" + name + ".safetensors"));
    return golden;
}
