// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

namespace srisp::train {

/// Settings are plain structs that describe themselves, once, for reading recipes, `--set`, messages and help alike:
///
///     struct LossSettings {
///         double clip_norm = 1;
///         std::string target = "raw";
///         template <class Visitor> void describe(Visitor& v) {
///             v.number("clip_norm", clip_norm, 1e-3, 1e3, "largest norm of the gradient");
///             v.choice("target", target, {"raw", "rgb"}, "what is compared");
///         }
///     };
///
/// A visitor has these members; `text` says in a few words what the setting is, its unit and where the default is from.
/// `group` enters the settings struct of a sub-object.
class SettingsVisitor {
public:
    virtual ~SettingsVisitor() = default;
    virtual void number(const char* name, double& value, double low, double high, const char* text) = 0;
    virtual void integer(const char* name, int& value, int low, int high, const char* text) = 0;
    virtual void flag(const char* name, bool& value, const char* text) = 0;
    virtual void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                        const char* text) = 0;
    virtual void path(const char* name, std::string& value, const char* text) = 0;
    /// Two numbers, low <= high, each within [low_limit, high_limit]: the range of a random draw.
    virtual void range(const char* name, double& low, double& high, double low_limit, double high_limit,
                       const char* text) = 0;

    template<class Settings> void group(const char* name, Settings& settings)
    {
        enter(name);
        settings.describe(*this);
        leave();
    }

protected:
    virtual void enter(const char* group_name) = 0;
    virtual void leave() = 0;
};

/// Common to the visitors here: they know settings by dotted keys ("loss.clip_norm").
class KeyedVisitor : public SettingsVisitor {
protected:
    std::string key(const char* name) const { return m_prefix + name; }
    void enter(const char* group_name) override;
    void leave() override;

private:
    std::string m_prefix;
    std::vector<std::size_t> m_prefix_lengths;
};

/// Takes settings out of a JSON object (a recipe); what it does not name stays as it is. Each value's type, range and
/// choice are checked; the first error stays.
class SettingsReader : public KeyedVisitor {
public:
    /// `where` starts every message ("recipe 'paper.json'").
    SettingsReader(const nlohmann::json& object, std::string where);

    /// Call it last: every key that no setting took is an error that lists the near ones.
    Status finish();

    void number(const char* name, double& value, double low, double high, const char* text) override;
    void integer(const char* name, int& value, int low, int high, const char* text) override;
    void flag(const char* name, bool& value, const char* text) override;
    void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                const char* text) override;
    void path(const char* name, std::string& value, const char* text) override;
    void range(const char* name, double& low, double& high, double low_limit, double high_limit,
               const char* text) override;

private:
    const nlohmann::json* find(const char* name);
    void fail(const char* name, const std::string& wanted, const nlohmann::json& value);

    nlohmann::json m_values; ///< by dotted key
    std::string m_where, m_error;
    std::vector<std::string> m_known;
};

/// Writes settings as a JSON object that SettingsReader takes back to the same values.
class SettingsWriter : public SettingsVisitor {
public:
    SettingsWriter();
    nlohmann::ordered_json object() const { return m_groups.front().second; }

    void number(const char* name, double& value, double low, double high, const char* text) override;
    void integer(const char* name, int& value, int low, int high, const char* text) override;
    void flag(const char* name, bool& value, const char* text) override;
    void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                const char* text) override;
    void path(const char* name, std::string& value, const char* text) override;
    void range(const char* name, double& low, double& high, double low_limit, double high_limit,
               const char* text) override;

private:
    void enter(const char* group_name) override;
    void leave() override;

    std::vector<std::pair<std::string, nlohmann::ordered_json>> m_groups;
};

/// One setting, for lists.
struct SettingRow {
    std::string key, value, range, text;
};

/// Lists settings with their present values.
class SettingsLister : public KeyedVisitor {
public:
    const std::vector<SettingRow>& rows() const { return m_rows; }

    void number(const char* name, double& value, double low, double high, const char* text) override;
    void integer(const char* name, int& value, int low, int high, const char* text) override;
    void flag(const char* name, bool& value, const char* text) override;
    void choice(const char* name, std::string& value, const std::vector<std::string>& allowed,
                const char* text) override;
    void path(const char* name, std::string& value, const char* text) override;
    void range(const char* name, double& low, double& high, double low_limit, double high_limit,
               const char* text) override;

private:
    std::vector<SettingRow> m_rows;
};

/// {"loss": {"clip_norm": 2}} → {"loss.clip_norm": 2}
nlohmann::json flat_settings(const nlohmann::json& object);

/// Turns "loss.clip_norm=2" into {"loss.clip_norm": 2}: what follows "=" is JSON, two numbers with a comma between
/// them, or else a text.
Expected<nlohmann::json> parse_assignment(const std::string& assignment);

} // namespace srisp::train
