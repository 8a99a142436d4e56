// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <OpenImageIO/imagebuf.h>
#include <srisp/srisp.h>

#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

extern char** environ;

namespace {

namespace fs = std::filesystem;
using namespace srisp;

/// A run of a program without its messages: wall seconds, and the peak of its largest process.
struct Run {
    double seconds, megabytes;
};

Run run(std::vector<std::string> words)
{
    Run result{};
    result.seconds = seconds([&] {
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        for (const int file : { 1, 2 })
            posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_WRONLY, 0);
        pid_t process = 0;
        const int failed = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        int status = 0;
        rusage usage{};
        if (failed || ::wait4(process, &status, 0, &usage) != process || status != 0)
            throw std::runtime_error("failed: " + words[0]);
        result.megabytes = double(usage.ru_maxrss) / 1024;
    });
    return result;
}

/// A folder of photos of one size, all alike, and what is measured with them.
class PhotoSet {
public:
    PhotoSet(const BenchSettings& settings, int width, int height, int most)
        : m_settings(settings), m_width(width), m_height(height)
    {
        Picture picture = bench_picture(settings, width, height);
        OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 3), picture.rgb.data());
        fs::create_directory(folder());
        if (!image.write(photo(0), OIIO::TypeUInt8))
            throw std::runtime_error("'" + photo(0) + "': " + image.geterror());
        for (int i = 1; i < most; ++i)
            fs::copy_file(photo(0), photo(i));
        Options options;
        options.precision = Precision::fast;
        m_result.emplace(require(unprocess(photo(0), settings.reference, options)));
    }

    std::string folder() const { return (m_folder.path() / "photos").string(); }
    std::string photo(int i) const { return folder() + "/" + std::to_string(i) + ".jpg"; }

    /// Seconds in which so many photos are decoded and results like theirs encoded and written, by so many threads.
    double decode_and_encode(int count, int threads) const
    {
        const std::string output = (m_folder.path() / "plain").string();
        fs::remove_all(output);
        fs::create_directory(output);
        std::atomic<int> next{ 0 };
        const auto work = [&] {
            for (int i = next++; i < count; i = next++) {
                const auto input = OIIO::ImageInput::open(photo(i));
                std::vector<unsigned char> codes(std::size_t(m_width) * std::size_t(m_height) * 3);
                if (!input || !input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, codes.data()))
                    std::abort();
                const auto bytes = require(m_result->encode("result.exr", OIIO::TypeHalf));
                std::ofstream file(output + "/" + std::to_string(i) + ".exr", std::ios::binary);
                file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
            }
        };
        return seconds([&] {
            std::vector<std::thread> all;
            for (int i = 0; i < threads; ++i)
                all.emplace_back(work);
            for (std::thread& thread : all)
                thread.join();
        });
    }

    /// The first so many photos by srispbatch.
    Run batch(int count, int threads, const std::vector<std::string>& more = {}) const
    {
        const std::string output = (m_folder.path() / "raw").string(), list = (m_folder.path() / "list").string();
        fs::remove_all(output);
        std::ofstream names(list);
        for (int i = 0; i < count; ++i)
            names << photo(i) << '\n';
        names.close();
        std::vector<std::string> words{
            m_settings.bin + "/srispbatch", "@" + list, "--reference", m_settings.reference, "-o", output, "--threads",
            std::to_string(threads)
        };
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }

    /// Seconds for so many photos, one command each.
    double loop(int count) const
    {
        return seconds([&] {
            for (int i = 0; i < count; ++i)
                run({ m_settings.bin + "/srisptool", photo(i), "--srisp-unprocess", m_settings.reference, "-d", "half",
                      "-o", (m_folder.path() / "one.exr").string() });
        });
    }

private:
    const BenchSettings& m_settings;
    const int m_width, m_height;
    tool::TemporaryFolder m_folder;
    std::optional<Image> m_result;
};

std::string per_photo(double seconds, int count)
{
    return digits(seconds / count * 1e3, 1) + " ms";
}

/// How many times as long the first of two things takes as the second: by the shortest of three runs each, in turn,
/// since other programs on a machine only ever make a run longer.
template<class First, class Second> double ratio(const First& first, const Second& second)
{
    double a = 1e30, b = 1e30;
    for (int i = 0; i < 3; ++i) {
        a = std::min<double>(a, first());
        b = std::min<double>(b, second());
    }
    return a / b;
}

BenchLine rate_line(const std::string& name, const PhotoSet& set, int count, int threads, const std::string& what)
{
    double plain = 1e30, ours = 1e30;
    const double share = ratio([&] { return plain = std::min(plain, set.decode_and_encode(count, threads)); },
                               [&] { return ours = std::min(ours, set.batch(count, threads).seconds); });
    return { name, share, "of the rate", ">= 0.8",
             what + " to half EXR, " + std::to_string(threads) + " threads; base: decoding and encoding alone, " +
                 per_photo(plain, count) + " a photo; srispbatch " + per_photo(ours, count) };
}

} // namespace

BenchLines bench_batch(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    constexpr int kPhotos = 400, kMany = 3000, kRate = 1000, kFew = 100, kLarge = 20, kLoop = 8;
    const int threads = settings.threads;
    OIIO::attribute("threads", 1); // a photo on each processor
    OIIO::attribute("exr_threads", -1);
    BenchLines lines;
    {
        const PhotoSet set(settings, 640, 480, kMany);
        lines.push_back(rate_line("batch_small", set, kRate, threads, "640 x 480 JPEG"));
        double each = 1e30;
        const double isolated = ratio([&] { return each = std::min(each, set.batch(kPhotos, threads).seconds); },
                                      [&] { return set.batch(kPhotos, threads, { "--no-isolate" }).seconds; });
        lines.push_back({ "batch_isolated", isolated - 1, "x", "<= 0.03",
                          "more time with photos decoded by processes of their own, " + per_photo(each, kPhotos) });
        const double cores =
            ratio([&] { return set.batch(kPhotos / 2, 1).seconds; }, [&] { return set.batch(kPhotos / 2, 2).seconds; });
        const double plain = ratio([&] { return set.decode_and_encode(kPhotos / 2, 1); },
                                   [&] { return set.decode_and_encode(kPhotos / 2, 2); });
        lines.push_back({ "batch_cores", cores, "x", ">= 1.9",
                          "the rate of two threads; base: one; of decoding and encoding alone " + digits(plain, 2) });
        const double loop = set.loop(kLoop) / kLoop;
        lines.push_back({ "batch_loop", loop / (each / kPhotos), "x", ">= 20",
                          "the rate; base: a loop over srisptool, " + digits(loop * 1e3, 0) + " ms a photo" });
        const Run few = set.batch(kFew, threads), many = set.batch(kMany, threads);
        lines.push_back({ "batch_flat", (many.seconds / kMany) / (few.seconds / kFew), "x", "<= 1",
                          "time a photo of " + std::to_string(kMany) + "; base: of " + std::to_string(kFew) });
        lines.push_back({ "batch_memory", many.megabytes - few.megabytes, "MB", "<= 20",
                          "largest process with " + std::to_string(kMany) + ", " + digits(many.megabytes, 0) +
                              " MB, beyond that with " + std::to_string(kFew) });
        const double again = run({ settings.bin + "/srispbatch", set.folder(), "--reference", settings.reference, "-o",
                                   set.folder() + "/../nothing", "--shard", "7/800", "--match", "1.jpg" })
                                 .seconds;
        lines.push_back({ "batch_shard", again, "s", "", "a shard without photos: start, plan and end" });
    }
    const PhotoSet large(settings, 4000, 3000, kLarge);
    lines.push_back(rate_line("batch_large", large, kLarge, threads, "12 Mpx JPEG"));
    return lines;
}
