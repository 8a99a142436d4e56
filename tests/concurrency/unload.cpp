// SPDX-License-Identifier: Apache-2.0
// A host that loads the plugin by itself, reads an image, and unloads it while OpenImageIO's threads are busy
// elsewhere: what the plugin gave them to do is still to come. Usage: unload PLUGIN PHOTO REFERENCE
#include <dlfcn.h>

#include <cstdio>
#include <future>
#include <memory>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/thread.h>

int main(int argc, char** argv)
{
    if (argc != 4)
        return 2;
    OIIO::thread_pool& pool = *OIIO::default_thread_pool();
    pool.resize(1);
    std::promise<void> release;
    std::shared_future<void> released = release.get_future().share();
    pool.push([released](int) { released.wait(); });

    void* const plugin = dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL); // as OpenImageIO does
    if (!plugin) {
        std::fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    using Create = OIIO::ImageInput* (*)();
    const auto create = reinterpret_cast<Create>(dlsym(plugin, "srisp_input_imageio_create"));
    {
        const std::unique_ptr<OIIO::ImageInput> input(create());
        OIIO::ImageSpec spec;
        if (!input->open(std::string(argv[2]) + ".srisp?reference=" + argv[3], spec)) {
            std::fprintf(stderr, "%s\n", input->geterror().c_str());
            return 2;
        }
        std::vector<float> pixels(spec.image_pixels() * std::size_t(spec.nchannels));
        if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
            return 2;
    }
    dlclose(plugin);
    const std::size_t waiting = pool.jobs_in_queue();
    release.set_value();
    pool.push([](int) {}).wait(); // all that came before has run
    std::printf("%zu tasks ran after the plugin was unloaded\n", waiting);
    return waiting ? 0 : 1; // none: this has tested nothing
}
