// SPDX-License-Identifier: Apache-2.0
#include <srisp/model.h>

#include "base/guarded.h"
#include "base/hashes.h"
#include "base/input_file.h"
#include "model/model_data.h"
#include "model/model_files.h"
#include "model/safetensors.h"
#include "model/shipped_model.h"

namespace srisp {

constexpr std::uint64_t kMaxModelBytes = 64 << 20; // a model has 1.2 M parameters

Model::Model(std::unique_ptr<const ModelData> data) : m_data(std::move(data)) {}
Model::~Model() = default;

Expected<std::shared_ptr<const Model>> Model::load(const std::string& name_or_path)
{
    return guarded("model", name_or_path, [&]() -> Expected<std::shared_ptr<const Model>> {
        Expected<std::string> path = find_model_file(name_or_path);
        if (!path)
            return path.error();
        const std::string where = "model '" + *path + "'";
        Expected<std::string> bytes = read_file(*path, kMaxModelBytes, where);
        if (!bytes)
            return bytes.error();
        if (const Status shipped = check_shipped_model(name_or_path, *path, *bytes); !shipped)
            return Error{ where + ": " + shipped.error().message };
        Expected<std::unique_ptr<ModelData>> model = parse_model(*bytes, where);
        if (!model)
            return model.error();
        (*model)->name = model_name_of_path(*path);
        (*model)->path = *path;
        (*model)->hash = hash_of_bytes(bytes->data(), bytes->size());
        return std::shared_ptr<const Model>(new Model(std::move(*model)));
    });
}

std::vector<std::string> Model::available()
{
    return model_names();
}

const std::string& Model::name() const
{
    return m_data->name;
}
const std::string& Model::path() const
{
    return m_data->path;
}
const std::string& Model::hash() const
{
    return m_data->hash;
}
int Model::kernel_size() const
{
    return m_data->kernel_size;
}
int Model::dictionary_size() const
{
    return m_data->dictionary_size;
}
const std::map<std::string, std::string>& Model::metadata() const
{
    return m_data->metadata;
}

} // namespace srisp
