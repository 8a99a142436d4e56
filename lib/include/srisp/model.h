// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

struct ModelData;

/// A trained model (`srisp-1` or `srisp-7` safetensors: float32, float16 or bfloat16 on disk, float32 here), checked in
/// full when it is loaded. Immutable, so it may be used by any number of threads.
class SRISP_API Model {
public:
    /// Loads a model by path (a name with '/' or ending in `.safetensors`) or by name (`default`, `spatial`). Names
    /// are looked for in the folders of SRISP_MODEL_PATH (colon-separated), then in `share/srisp/models` beside this
    /// library (install tree or build tree). Fails with one message for a missing, truncated, malformed or degenerate
    /// file.
    static Expected<std::shared_ptr<const Model>> load(const std::string& name_or_path);

    /// The names that `load` finds now, sorted.
    static std::vector<std::string> available();

    ~Model();
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    const std::string& name() const;                            ///< base name of the file, without folder and extension
    const std::string& path() const;                            ///< the file that was read
    const std::string& hash() const;                            ///< "xxh128:" and 32 hex digits, of the file's bytes
    int kernel_size() const;                                    ///< of the tone map: 3 (spatial) or 1 (pointwise)
    int dictionary_size() const;                                ///< atoms per dictionary
    const std::map<std::string, std::string>& metadata() const; ///< `__metadata__` of the file

private:
    friend const ModelData& model_data(const Model& model);
    explicit Model(std::unique_ptr<const ModelData> data);
    std::unique_ptr<const ModelData> m_data;
};

} // namespace srisp
