// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

/// One thing that hosts do, through a door of theirs: the OpenImageIO plugins or the library. It gives a digest of all
/// bits that come of it, or the error's text. Any number of threads may run it, and it gives the same each time.
struct Job {
    std::string name;
    std::function<std::string()> run;
};

/// Lets OpenImageIO find the plugins of this build, writes the files to work on into `folder`, and lists what can be
/// done with them: small photos of several kinds, damaged ones, two references, all kinds of results. The jobs share
/// readers, a cache, models and references.
std::vector<Job> make_jobs(const std::string& folder);

/// What each gives on one thread.
std::vector<std::string> results_of(const std::vector<Job>& jobs);

/// Whether a job gives what it should; says so on stderr where it does not.
bool gives(const Job& job, const std::string& expected);
