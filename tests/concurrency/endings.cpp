// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <thread>

#include "concurrency/jobs.h"
#include "scratch_folder.h"
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/thread.h>

static int wait_for(pid_t child)
{
    int status;
    waitpid(child, &status, 0);
    return status;
}

int main(int argc, char** argv)
{
    const std::string mode = argc > 1 ? argv[1] : "";
    const ScratchFolder folder;
    std::vector<Job> jobs = make_jobs(folder.path());
    for (size_t i = jobs.size(); i-- > 0;)
        if (jobs[i].name.find("exr") != std::string::npos || jobs[i].name == "process" || jobs[i].name == "develop")
            jobs.erase(jobs.begin() + i);
    std::fprintf(stderr, "%zu\n", jobs.size());
    if (mode == "fork" || mode == "forkexit") {
        const std::vector<std::string> expected = results_of(jobs);
        OIIO::attribute("threads", 4);
        for (size_t i = 0; i < jobs.size(); i += 5)
            gives(jobs[i], expected[i]);
        for (int round = 0; round < 3; ++round) {
            pid_t child = fork();
            if (child == 0) {
                alarm(15);
                int bad = 0;
                for (size_t i = round; i < jobs.size(); i += 3) {
                    if (jobs[i].name.find("exr") != std::string::npos)
                        continue;
                    if (getenv("DBG"))
                        fprintf(stderr, "%s\n", jobs[i].name.c_str());
                    bad += !gives(jobs[i], expected[i]);
                }
                if (mode == "fork")
                    _exit(bad ? 1 : 0);
                fprintf(stderr, "done\n");
                exit(bad ? 1 : 0);
            }
            std::printf("%d: status %x\n", round, wait_for(child));
        }
    }
    if (mode == "exit" || mode == "forkbusy") {
        OIIO::attribute("threads", 4);
        for (int i = 0; i < 16; ++i)
            std::thread([&jobs, i, argv] {
                std::mt19937 random(i + atoi(argv[2]));
                while (true)
                    jobs[random() % jobs.size()].run();
            }).detach();
        std::this_thread::sleep_for(std::chrono::milliseconds(atoi(argv[2])));
        if (mode == "exit")
            exit(0);
        for (int i = 0; i < 20; ++i) {
            pid_t child = fork();
            if (child == 0) {
                alarm(20);
                for (size_t j = i; j < jobs.size(); j += 29)
                    jobs[j].run();
                _exit(0);
            }
            std::printf("%d: status %x\n", i, wait_for(child));
        }
        _exit(0);
    }
}
