// A place for files that other programs read.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace penumbra::test {

/// A folder that is gone in the end.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("penumbra-test-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
        return (path / name).string();
    }
    /// Runs a command there. Its output is printed if it fails.
    bool run(const std::string& command) const {
        const std::string log = (path / "log").string();
        if (std::system(("cd '" + path.string() + "' && (" + command + ") >'" + log + "' 2>&1").c_str()) == 0)
            return true;
        std::printf("failed: %s\n", command.c_str());
        std::ifstream in(log);
        for (std::string line; std::getline(in, line);) std::printf("    %s\n", line.c_str());
        return false;
    }
    std::string read(const std::string& name) const {
        std::ifstream in(path / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

}  // namespace penumbra::test
