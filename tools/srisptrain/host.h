// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/progress.h"
#include "session.h"

namespace srisp::tool {

/// What a training run asks of this program: tests, model files, and telling people.
class Host : public train::RunHost {
public:
    Host(const Session& session, bool quiet) : m_session(session), m_line(!quiet) {}

    std::optional<train::Validation> validate(train::Unprocessor& model, const train::StillThere& still_there) override;
    Status save_model(train::Unprocessor& model, const std::string& path,
                      const std::optional<train::Validation>& result, std::int64_t step) override;
    void progress(const train::RunProgress& progress) override;
    /// A line that stays, said even when quiet.
    void note(const std::string& line) override;

private:
    const Session& m_session;
    ProgressLine m_line;
};

} // namespace srisp::tool
