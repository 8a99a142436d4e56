// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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

} // namespace srisp::train
