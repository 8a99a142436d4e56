// SPDX-License-Identifier: Apache-2.0
#include "base/json_text.h"

#include <algorithm>
#include <vector>

#include "base/shown_text.h"

namespace srisp {

namespace {

using nlohmann::json;

/// Why a text was refused.
struct Fault {
    enum class Kind { none, grammar, number, depth, twice } kind = Kind::none;
    std::size_t byte = 0; ///< of grammar
    std::string key;      ///< of twice
};

/// Builds a value from what nlohmann's parser reports, which itself needs no stack for depth; linear in the text, which
/// its own callbacks are not.
template<class Json> class Builder : public nlohmann::json_sax<Json> {
public:
    Json root;
    Fault fault;

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(typename Json::number_integer_t value) override { return add(value); }
    bool number_unsigned(typename Json::number_unsigned_t value) override { return add(value); }
    bool number_float(typename Json::number_float_t value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(std::move(value)); }
    bool binary(typename Json::binary_t&) override { return false; } // JSON has none
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& name) override
    {
        auto& object = m_open.back()->template get_ref<typename Json::object_t&>();
        const auto [entry, is_new] = object.emplace(name, nullptr);
        m_member = &entry->second;
        if (!is_new)
            fault = { Fault::Kind::twice, 0, std::move(name) };
        return is_new;
    }
    bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& thrown) override
    {
        constexpr int kOutOfRange = 406;
        fault = { thrown.id == kOutOfRange ? Fault::Kind::number : Fault::Kind::grammar, byte, "" };
        return false;
    }

private:
    /// Where the next value belongs.
    Json& place()
    {
        if (m_open.empty())
            return root;
        if (!m_open.back()->is_array())
            return *m_member;
        m_open.back()->push_back(nullptr);
        return m_open.back()->back();
    }
    template<class Value> bool add(Value&& value)
    {
        place() = std::forward<Value>(value);
        return true;
    }
    bool open(Json&& value)
    {
        if (m_open.size() == kDeepestJson) {
            fault.kind = Fault::Kind::depth;
            return false;
        }
        Json& opened = place();
        opened = std::move(value);
        m_open.push_back(&opened);
        return true;
    }
    bool close()
    {
        m_open.pop_back();
        return true;
    }

    std::vector<Json*> m_open;
    Json* m_member = nullptr; ///< of the innermost object, for its last key
};

template<class Json> Fault parse(std::string_view text, Json& value)
{
    Builder<Json> builder;
    Json::sax_parse(text.begin(), text.end(), &builder);
    value = std::move(builder.root);
    return builder.fault;
}

std::string size_reason(std::string_view text, std::size_t most)
{
    return "has " + std::to_string(text.size()) + " bytes of JSON, limit " + std::to_string(most);
}

std::string depth_reason()
{
    return "is nested more than " + std::to_string(kDeepestJson) + " levels deep";
}

/// "line 3, column 7" of a byte, counted from 1.
std::string place_of(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, byte);
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    return "line " + std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ", column " +
           std::to_string(std::max<std::size_t>(1, byte - line_start));
}

} // namespace

template<class Json> Expected<Json> parse_json(std::string_view text, std::size_t most)
{
    if (text.size() > most)
        return Error{ size_reason(text, most) };
    Json value;
    const Fault fault = parse(text, value);
    switch (fault.kind) {
    case Fault::Kind::none:
        return value;
    case Fault::Kind::grammar:
        break;
    case Fault::Kind::number:
        return Error{ "has a number that is too large" };
    case Fault::Kind::depth:
        return Error{ depth_reason() };
    case Fault::Kind::twice:
        return Error{ "has '" + shown_text(fault.key) + "' twice in one object" };
    }
    return Error{ kNotJson };
}

template Expected<nlohmann::json> parse_json(std::string_view, std::size_t);
template Expected<nlohmann::ordered_json> parse_json(std::string_view, std::size_t);

Expected<json> parse_json_object(std::string_view text, const std::string& where, const std::string& part,
                                 std::size_t most)
{
    const std::string subject = where + ": " + part + " ", message = subject + "is not a JSON object";
    if (text.size() > most)
        return Error{ subject + size_reason(text, most) };
    json object;
    const Fault fault = parse(text, object);
    switch (fault.kind) {
    case Fault::Kind::none:
        break;
    case Fault::Kind::grammar:
        return Error{ message + " (" + place_of(text, fault.byte) + ")" };
    case Fault::Kind::number:
        return Error{ message + " that can be read (a number is too large)" };
    case Fault::Kind::depth:
        return Error{ subject + depth_reason() };
    case Fault::Kind::twice:
        return Error{ where + ": '" + shown_text(fault.key) + "' appears twice in the " + part };
    }
    return object.is_object() ? Expected<json>(std::move(object)) : Error{ message };
}

template<class Json> std::string shown_json(const Json& value)
{
    return shown_text(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

template std::string shown_json(const nlohmann::json&);
template std::string shown_json(const nlohmann::ordered_json&);

} // namespace srisp
