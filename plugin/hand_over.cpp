// SPDX-License-Identifier: Apache-2.0
#include "hand_over.h"

#include <algorithm>
#include <filesystem>

#include "base/json_text.h"
#include "process_state.h"

namespace srisp::plugin {

namespace {

const char kStubFormat[] = "srisp-slot-1";

const SlotLevel* find_level_of(const Slot* slot, int subimage, int miplevel)
{
    if (!slot || subimage < 0 || subimage >= static_cast<int>(slot->subimages.size()))
        return nullptr;
    const auto& levels = slot->subimages[subimage];
    return miplevel >= 0 && miplevel < static_cast<int>(levels.size()) ? &levels[miplevel] : nullptr;
}

class SlotSource : public PixelSource {
public:
    SlotSource(const std::string& id, const std::string& name) : m_id(id), m_name(name), m_key("slot " + id) {}

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        const auto slot = process_state().slots.find(m_id);
        const SlotLevel* level = find_level_of(slot.get(), subimage, miplevel);
        return level ? std::optional<OIIO::ImageSpec>(level->spec) : std::nullopt;
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        const auto slot = process_state().slots.find(m_id);
        const SlotLevel* level = find_level_of(slot.get(), subimage, miplevel);
        if (!level)
            return Error{ m_name + ": is no longer kept; a later frame has taken its place" };
        const std::size_t row = std::size_t(level->spec.width) * std::size_t(level->spec.nchannels);
        for (int y = y0; y < y1; ++y)
            level->rows.get(std::size_t(y), rows + row * std::size_t(y - y0));
        return {};
    }

    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_key; }

private:
    std::string m_id, m_name, m_key;
};

} // namespace

StubName parse_stub_name(const std::string& path)
{
    StubName parts;
    const std::filesystem::path file(path);
    const std::string name = file.filename().string();
    const std::size_t first = std::min(name.find('.'), name.size());
    parts.job = (file.parent_path() / (name.substr(0, first) + ".json")).string();
    const std::size_t second = name.find('.', first + 1);
    std::string frame =
        first < name.size() && second != std::string::npos ? name.substr(first + 1, second - first - 1) : "";
    if (frame.find_first_not_of("-0123456789") != std::string::npos)
        frame.clear();
    parts.frame = frame;
    return parts;
}

std::string stub_text(const std::string& id)
{
    return nlohmann::ordered_json{ { "format", kStubFormat }, { "slot", id } }.dump() + "\n";
}

std::optional<std::string> parse_stub(const std::string& text)
{
    const auto stub = parse_json<nlohmann::json>(text);
    if (!stub || !stub->is_object() || stub->value("format", nlohmann::json()) != kStubFormat)
        return {};
    const nlohmann::json slot = stub->value("slot", nlohmann::json());
    return slot.is_string() ? slot.get<std::string>() : "";
}

std::unique_ptr<PixelSource> open_slot_source(const std::string& id, const std::string& name)
{
    return std::make_unique<SlotSource>(id, name);
}

} // namespace srisp::plugin
