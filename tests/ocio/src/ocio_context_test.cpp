// SPDX-License-Identifier: Apache-2.0
#include <srisp/ocio_context.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <doctest/doctest.h>
#include <srisp/ocio_transform.h>
#include <srisp/photo.h>

#include "image_compare.h"
#include "ocio/ocio_pixels.h"

using namespace srisp;

namespace {

const std::string kSample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
const std::string kConfig = std::string(SRISP_SOURCE_DIR) + "/configs/ocio/srisp.ocio";

/// A config and a context to set variables in.
struct Host {
    OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(kConfig.c_str());
    OCIO::ContextRcPtr context = config->getCurrentContext()->createEditableCopy();

    explicit Host(const std::string& reference, const std::string& source = "")
    {
        context->setStringVar("SRISP_REFERENCE", reference.c_str());
        context->setStringVar("SRISP_SOURCE", source.c_str());
        context->setStringVar("SRISP_MODEL", default_model()->path().c_str());
    }
    Expected<OCIO::ConstGroupTransformRcPtr> ask(Direction direction = Direction::reverse) const
    {
        return transform_from_context(config, context, direction);
    }
    std::string failure() const
    {
        const auto transform = ask();
        return transform ? "" : transform.error().message;
    }
};

} // namespace

TEST_CASE("context variables give the transform that the library's own selection gives")
{
    const auto model = default_model();
    const auto reference = require(load_reference(kSample + "reference.dng"));
    const Thumbnail photo = require(load_photo_thumbnail(kSample + "photo.jpg"));
    const Colors grid = dense_grid(16);
    for (const bool with_photo : { false, true })
        for (const Direction direction : { Direction::reverse, Direction::forward }) {
            const Host host(kSample + "reference.dng", with_photo ? kSample + "photo.jpg" : "");
            const Parameters parameters = require(
                srisp::select(*model, with_photo ? photo : neutral_rendition(*reference), reference->thumbnail));
            const Difference difference =
                compare(through_ocio(require(host.ask(direction)), grid),
                        through_ocio(require(make_ocio_transform(*model, parameters, direction)), grid));
            INFO(difference.text);
            CHECK(difference.largest == 0);
        }
}

TEST_CASE("transforms are kept by content: other names give the same one, a changed file another")
{
    const ScratchFolder folder;
    const std::string copy = folder.path("größe $A %B%.dng"), photo = folder.path("p.jpg");
    std::filesystem::copy_file(kSample + "reference.dng", copy);
    std::filesystem::copy_file(kSample + "photo.jpg", photo);
    const auto first = require(Host(kSample + "reference.dng", photo).ask());
    CHECK(require(Host(copy, kSample + "photo.jpg").ask()) == first);
    CHECK(require(Host(copy, "").ask()) != first);
    CHECK(require(Host(copy, photo).ask(Direction::forward)) != first);
    std::ofstream(photo, std::ios::app | std::ios::binary) << "x"; // behind the end of the JPEG: another content
    CHECK(require(Host(copy, photo).ask()) != first);
}

TEST_CASE("many threads with two references get what one thread gets")
{
    const ScratchFolder folder;
    std::string bytes;
    {
        std::ifstream file(kSample + "reference.dng", std::ios::binary);
        std::stringstream all;
        all << file.rdbuf();
        bytes = all.str();
    }
    for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 100000; ++i)
        bytes[i] = '\1'; // a dark band
    write_file(folder.path("other.dng"), bytes);
    const Host hosts[] = { Host(kSample + "reference.dng"), Host(folder.path("other.dng")) };
    const Colors grid = dense_grid(8);
    Colors results[8];
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([&, i] {
            const auto transform = hosts[i % 2].ask();
            if (transform)
                results[i] = through_ocio(*transform, grid);
        });
    for (std::thread& thread : threads)
        thread.join();
    for (int i = 0; i < 8; ++i) {
        REQUIRE(!results[i].empty());
        CHECK(results[i] == results[i % 2]);
    }
    CHECK(results[0] != results[1]);
}

TEST_CASE("without a reference the config's neutral bakes are what both ways give")
{
    const Host host("srisp_neutral");
    const Colors grid = dense_grid(12);
    for (const Direction direction : { Direction::reverse, Direction::forward }) {
        auto file = OCIO::FileTransform::Create();
        file->setSrc(direction == Direction::reverse ? "srisp_neutral.unprocess.clf" : "srisp_neutral.process.clf");
        Colors baked = grid;
        OCIO::PackedImageDesc image(baked.data(), long(baked.size() / 3), 1, 3);
        host.config->getProcessor(file)->getDefaultCPUProcessor()->apply(image);
        const Difference difference = compare(through_ocio(require(host.ask(direction)), grid), baked);
        INFO(difference.text);
        CHECK(difference.largest <= 2e-6);
    }
    // The config declares the variable, so its own context will do.
    unsetenv("SRISP_REFERENCE");
    CHECK(transform_from_context(OCIO::Config::CreateFromFile(kConfig.c_str())));
}

TEST_CASE("a name without a folder is found in the config's search path")
{
    const ScratchFolder folder;
    std::filesystem::copy_file(kSample + "reference.dng", folder.path("r.dng"));
    const Host absolute(folder.path("r.dng"));
    Host relative("r.dng");
    relative.context->addSearchPath(std::filesystem::path(folder.path("r.dng")).parent_path().c_str());
    CHECK(require(relative.ask()) == require(absolute.ask()));
}

TEST_CASE("what is missing or wrong is named with its variable")
{
    CHECK(Host("").failure() ==
          "context variable SRISP_REFERENCE is not set; it is the path of the reference's RAW file");
    CHECK(transform_from_context(nullptr).error().message == "transform from context: no config is given");
    CHECK(Host("/missing/r.dng").failure().find("SRISP_REFERENCE='/missing/r.dng': ") == 0);
    CHECK(Host(kSample + "photo.jpg").failure().find("SRISP_REFERENCE: reference '") == 0);
    CHECK(Host(kSample + "reference.dng", "/missing.jpg").failure().find("SRISP_SOURCE='/missing.jpg': ") == 0);
    CHECK(Host(kSample + "reference.dng", kSample + "README.md").failure().find("SRISP_SOURCE: photo '") == 0);
    const Host host(kSample + "reference.dng");
    host.context->setStringVar("SRISP_MODEL", "spatail");
    CHECK(host.failure().find("SRISP_MODEL: unknown model 'spatail'") == 0);
    const std::string spatial = std::string(SRISP_SOURCE_DIR) + "/configs/models/spatial.safetensors";
    host.context->setStringVar("SRISP_MODEL", spatial.c_str());
    CHECK(host.failure().find("SRISP_MODEL: model 'spatial': its tone map looks at 3 x 3 pixels") == 0);
}
