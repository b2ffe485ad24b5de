#include "studies/develop/page_server.h"

#include "base/error.h"
#include "embedded_develop_page.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <thread>

namespace shadowbench::develop {
namespace {

using httplib::Server;

constexpr const char* loopback = "127.0.0.1";
constexpr std::size_t threads = 16; // a page that is open keeps one; a browser opens up to six more for pictures

/// No other page may hold this one in a frame, take its pictures, or have it load anything from elsewhere.
const httplib::Headers& headers() {
    static const httplib::Headers all{
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src "
         "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"X-Content-Type-Options", "nosniff"},
        {"Referrer-Policy", "no-referrer"},
        {"Cache-Control", "no-store"}};
    return all;
}

void answerFile(httplib::Response& response, std::string_view name, const char* type) {
    const auto files = embedded::develop_page();
    const auto found = std::ranges::find(files, name, &embedded::File::path);
    if (found == files.end()) throw InternalError(fmt::format("the program has no page \"{}\"", name));
    response.set_content(found->text.data(), found->text.size(), type);
}

void refuse(httplib::Response& response, int status, const std::string& reason) {
    response.status = status;
    response.set_content(reason + "\n", "text/plain");
}

/// Server-sent events: each version of the state once, and now and then a comment, which finds out that nobody listens.
void answerEvents(LiveState& state, httplib::Response& response) {
    const auto seen = std::make_shared<std::uint64_t>(0);
    response.set_chunked_content_provider("text/event-stream", [&state, seen](std::size_t, httplib::DataSink& sink) {
        constexpr std::chrono::seconds silence{5};
        const auto news = state.newsAfter(*seen, silence);
        if (state.isClosed()) return false;
        if (news) *seen = news->version;
        const std::string event = news ? fmt::format("data: {}\n\n", news->json) : std::string(": \n\n");
        return sink.write(event.data(), event.size());
    });
}

void answerPicture(const LiveState& state, const httplib::Request& request, httplib::Response& response) {
    const std::string digits = request.matches[1], kind = request.matches[2];
    std::uint64_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const auto pictures = state.pictures(number);
    if (!pictures) return refuse(response, 404, "this picture is no longer kept");
    const std::string& png = kind == "truth" ? pictures->truth : kind == "error" ? pictures->error : pictures->visibility;
    response.set_content(png, "image/png");
}

} // namespace

struct PageServer::Running {
    LiveState& state;
    Server server;
    int port = 0;
    std::atomic<bool> ended = false;
    std::thread thread;

    explicit Running(LiveState& shown) : state(shown) {
        server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
        server.set_keep_alive_max_count(1); // an idle connection would keep a thread
        server.set_payload_max_length(1024);
        server.set_default_headers(headers());
        server.set_socket_options([](int socket) { // without the library's SO_REUSEPORT, by which two could have one port
            const int yes = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        route();
        port = server.bind_to_any_port(loopback);
        if (port < 0) throw Inconclusive("there is no free port on the loopback address; end a server and try again");
        thread = std::thread([this] {
            server.listen_after_bind();
            ended = true;
        });
    }

    ~Running() {
        state.close();
        while (!server.is_running() && !ended)
            std::this_thread::sleep_for(std::chrono::milliseconds(1)); // to be stopped, it must run
        server.stop();
        thread.join();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    [[nodiscard]] bool isOwn(const std::string& host) const {
        return host == fmt::format("{}:{}", loopback, port) || host == fmt::format("localhost:{}", port);
    }

    void route() {
        server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            const std::string origin = request.get_header_value("Origin");
            constexpr std::string_view scheme = "http://";
            const bool reads = request.method == "GET" || request.method == "HEAD";
            if (!isOwn(request.get_header_value("Host")))
                refuse(response, 421, fmt::format("this is http://{}:{}/ and nothing else", loopback, port));
            else if (!reads && !(origin.starts_with(scheme) && isOwn(origin.substr(scheme.size()))))
                refuse(response, 403, "only the page itself changes what it shows");
            else
                return Server::HandlerResponse::Unhandled;
            return Server::HandlerResponse::Handled;
        });
        server.Get("/", [](const auto&, auto& response) { answerFile(response, "index.html", "text/html; charset=utf-8"); });
        server.Get("/develop.js", [](const auto&, auto& response) {
            answerFile(response, "develop.js", "text/javascript; charset=utf-8");
        });
        server.Get("/develop.css",
                   [](const auto&, auto& response) { answerFile(response, "develop.css", "text/css; charset=utf-8"); });
        server.Get("/events", [this](const auto&, auto& response) { answerEvents(state, response); });
        server.Get("/pictures/([0-9]{1,18})/(visibility|truth|error)\\.png",
                   [this](const auto& request, auto& response) { answerPicture(state, request, response); });
        server.Post("/keep", [this](const auto&, auto& response) {
            state.keep();
            response.status = 204;
        });
    }
};

PageServer::PageServer(LiveState& state) : running_(std::make_unique<Running>(state)) {}

PageServer::~PageServer() = default;

int PageServer::port() const { return running_->port; }

} // namespace shadowbench::develop
