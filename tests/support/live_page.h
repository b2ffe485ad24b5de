// `shadowbench develop` as a user runs it, and what its page is sent.
#pragma once

#include "tests/support/program.h"
#include "tests/support/technique_folders.h"

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <httplib.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shadowbench {

class LivePage {
public:
    /// Starts it on a scene, without one on a tiny one, with `temporary` as its TMPDIR, and waits until the page can be
    /// opened.
    LivePage(const std::filesystem::path& technique, const std::filesystem::path& temporary,
             const std::vector<std::string>& more = {}, std::string scene = "") {
        if (scene.empty()) scene = folder_.write("tiny.toml", tinyScene());
        words_ = {PROGRAM, "develop", technique.string(), "--scene", scene, "--cache", "/tmp/shadowbench-test-references"};
        words_.insert(words_.end(), more.begin(), more.end());
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        child_ = ::fork();
        if (child_ == 0) become(ends[1], temporary);
        ::close(ends[1]);
        output_ = ::fdopen(ends[0], "r");
        readPort();
    }
    ~LivePage() {
        if (child_ > 0) end(SIGKILL);
        std::fclose(output_);
    }
    LivePage(const LivePage&) = delete;
    LivePage& operator=(const LivePage&) = delete;

    [[nodiscard]] int port() const { return port_; }
    [[nodiscard]] pid_t process() const { return child_; }
    [[nodiscard]] std::string address() const { return "http://127.0.0.1:" + std::to_string(port_); }
    [[nodiscard]] httplib::Client client() const { return httplib::Client("127.0.0.1", port_); }
    [[nodiscard]] httplib::Headers ownOrigin() const { return {{"Origin", address()}}; }

    /// The first state sent for which `holds`.
    [[nodiscard]] nlohmann::json stateWhere(const std::function<bool(const nlohmann::json&)>& holds) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        nlohmann::json found;
        std::string received;
        auto listening = client();
        listening.set_read_timeout(20);
        listening.Get("/events", [&](const char* bytes, std::size_t size) {
            received.append(bytes, size);
            for (std::size_t stop = received.find("\n\n"); stop != std::string::npos; stop = received.find("\n\n")) {
                const std::string event = received.substr(0, stop);
                received.erase(0, stop + 2);
                if (!event.starts_with("data: ")) continue;
                nlohmann::json state = nlohmann::json::parse(event.substr(6));
                if (holds(state)) {
                    found = std::move(state);
                    return false;
                }
            }
            return std::chrono::steady_clock::now() < end;
        });
        if (found.is_null()) throw std::runtime_error("no such state was sent in 20 s; the last bytes: " + received);
        return found;
    }

    /// The first that shows a drawing of all rows later than `number`.
    [[nodiscard]] nlohmann::json drawnAfter(int number) const {
        return stateWhere([number](const nlohmann::json& state) {
            return !state["drawing"] && !state["rows"].empty() && state["rows"][0]["error"] == "" && state["error"] == "" &&
                   state["rows"][0]["last"] > number;
        });
    }

    /// The status of waitpid() once it has ended by the signal.
    int end(int signal) {
        ::kill(child_, signal);
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = -1;
        return status;
    }

private:
    [[noreturn]] void become(int output, const std::filesystem::path& temporary) {
        ::setenv("TMPDIR", temporary.c_str(), 1);
        ::dup2(output, 1);
        ::dup2(output, 2);
        std::vector<char*> pointers;
        for (std::string& word : words_) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }

    void readPort() {
        std::array<char, 4096> line{};
        std::string said;
        const std::string before = "page: http://127.0.0.1:";
        while (std::fgets(line.data(), line.size(), output_) != nullptr) {
            said += line.data();
            if (!std::string_view(line.data()).starts_with(before)) continue;
            port_ = std::stoi(std::string(line.data()).substr(before.size()));
            return;
        }
        throw std::runtime_error("develop has not begun: " + said);
    }

    Folder folder_;
    std::vector<std::string> words_;
    FILE* output_ = nullptr;
    pid_t child_ = -1;
    int port_ = 0;
};

} // namespace shadowbench
