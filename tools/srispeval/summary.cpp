// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bootstrap.h"
#include "metric_table.h"

namespace srisp::tool {

namespace {

constexpr std::uint64_t kSeed = 1;

using Images = std::vector<const ImageScore*>;

class Group {
public:
    Group(const Images& images, const std::vector<std::string>& methods)
        : m_images(images), m_methods(methods), m_files(number_files(images)), m_bootstrap(m_files.size(), kSeed)
    {
    }

    GroupSummary summary(const std::string& rendering, const std::string& camera) const
    {
        GroupSummary result;
        result.rendering = rendering;
        result.camera = camera;
        result.images = int(m_images.size());
        result.files = int(m_files.size());
        std::set<std::string> cameras;
        for (const ImageScore* image : m_images)
            cameras.insert(image->camera);
        result.cameras = int(cameras.size());
        for (const std::string& method : m_methods)
            result.methods.push_back(of_method(method));
        return result;
    }

private:
    static std::map<std::string, std::size_t> number_files(const Images& images)
    {
        std::map<std::string, std::size_t> files;
        for (const ImageScore* image : images)
            files.emplace(image->image, files.size());
        return files;
    }

    /// `value(score)` gives a Measured for each image.
    template<class Value> PerFile per_file(const std::string& method, const Value& value) const
    {
        PerFile files(m_files.size());
        for (const ImageScore* image : m_images) {
            const auto score = image->methods.find(method);
            if (score == image->methods.end())
                continue;
            files[m_files.at(image->image)] += value(score->second);
        }
        return files;
    }

    PerFile of_metric(const std::string& method, const std::string& key) const
    {
        return per_file(method, [&](const MethodScore& score) { return score.value(key); });
    }

    static bool is_empty(const PerFile& files)
    {
        return std::all_of(files.begin(), files.end(), [](const Measured& one) { return one.weight == 0; });
    }

    Interval mean(const PerFile& files) const
    {
        return m_bootstrap.interval([&](const FileCounts& counts) { return pooled(files, counts); });
    }

    MethodSummary of_method(const std::string& method) const
    {
        MethodSummary result;
        result.method = method;
        for (const Metric& one : metrics()) {
            const PerFile files = of_metric(method, one.key);
            if (is_empty(files))
                continue;
            result.values[one.key] = mean(files);
            const PerFile base = of_metric(m_methods.front(), one.key);
            if (method != m_methods.front() && !is_empty(base))
                result.over_baseline[one.key] = m_bootstrap.interval(
                    [&](const FileCounts& counts) { return pooled(files, counts) - pooled(base, counts); });
        }
        for (std::size_t level = 0; level < result.error_by_level.size(); ++level)
            result.error_by_level[level] =
                mean(per_file(method, [&](const MethodScore& score) { return score.error_by_level[level]; }));
        result.brightness_spread = spread(method);
        if (result.values.count(key::kErrorInDeviations))
            for (const double z : kCoverage)
                result.coverage.push_back(share_within(method, z));
        return result;
    }

    /// Of the errors of brightness, those of at most z of the deviations told.
    double share_within(const std::string& method, double z) const
    {
        const PerFile files = per_file(method, [&](const MethodScore& score) {
            const Measured error = score.value(key::kErrorInDeviations);
            return Measured{ error.weight > 0 && error.sum <= z ? 1.0 : 0.0, error.weight };
        });
        return pooled(files, FileCounts(m_files.size(), 1));
    }

    Interval spread(const std::string& method) const
    {
        const PerFile values = of_metric(method, key::kBrightness);
        const PerFile squares = per_file(method, [](const MethodScore& score) {
            const Measured error = score.value(key::kBrightness);
            return Measured{ error.sum * error.sum, error.weight };
        });
        return m_bootstrap.interval([&](const FileCounts& counts) {
            const double average = pooled(values, counts);
            return std::sqrt(std::max(pooled(squares, counts) - average * average, 0.0));
        });
    }

    const Images& m_images;
    const std::vector<std::string>& m_methods;
    std::map<std::string, std::size_t> m_files;
    Bootstrap m_bootstrap;
};

/// A rank correlation is told by references of several cameras.
GroupSummary without_ranks(GroupSummary group)
{
    for (MethodSummary& method : group.methods)
        for (const char* const rank : { key::kRankRed, key::kRankGreen, key::kRankBlue }) {
            method.values.erase(rank);
            method.over_baseline.erase(rank);
        }
    return group;
}

} // namespace

std::vector<GroupSummary> summarize(const std::vector<ImageScore>& images, const std::vector<std::string>& methods,
                                    const std::set<std::string>& seen)
{
    std::vector<std::string> renderings; // in the order in which they come
    std::map<std::string, Images> whole, unseen;
    std::map<std::string, std::map<std::string, Images>> by_camera;
    for (const ImageScore& image : images) {
        if (!whole.count(image.rendering))
            renderings.push_back(image.rendering);
        whole[image.rendering].push_back(&image);
        by_camera[image.rendering][image.camera].push_back(&image);
        if (!seen.count(image.camera))
            unseen[image.rendering].push_back(&image);
    }
    std::vector<GroupSummary> groups;
    for (const std::string& rendering : renderings)
        groups.push_back(Group(whole[rendering], methods).summary(rendering, ""));
    for (const std::string& rendering : renderings)
        if (!unseen[rendering].empty() && unseen[rendering].size() < whole[rendering].size())
            groups.push_back(Group(unseen[rendering], methods).summary(rendering, kUnseenCameras));
    for (const std::string& rendering : renderings)
        if (by_camera[rendering].size() > 1)
            for (const auto& [camera, some] : by_camera[rendering])
                groups.push_back(without_ranks(Group(some, methods).summary(rendering, camera)));
    return groups;
}

} // namespace srisp::tool
