#include "studio/server.hpp"

#include "common/error.hpp"
#include "page/page.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <charconv>
#include <functional>
#include <thread>

namespace servoid::studio {

namespace {

using httplib::Request;
using httplib::Response;

constexpr auto kPatience = std::chrono::seconds(20); // of a long poll
constexpr auto kCrowded = std::chrono::seconds(1);   // of those beyond kMostWaiting
constexpr size_t kLargest = size_t(1) << 30U;        // capture
constexpr size_t kThreads = 64;                      // a tab holds one while it waits
constexpr const char* kNoAction = "that is no JSON object of an action";
constexpr int kMostWaiting = 48; // the others act meanwhile

// One of those who wait, for as long as it lives.
struct Waiting {
    std::atomic<int>& count;
    const int place;
    explicit Waiting(std::atomic<int>& c) : count(c), place(++c) {}
    ~Waiting() { --count; }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
    bool crowded() const { return place > kMostWaiting; }
};

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != long(bytes.size()))
        throw UsageError("no random numbers for the token");
    std::string out;
    for (const unsigned char byte : bytes)
        out += fmt::format("{:02x}", byte);
    return out;
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void answer(Response& response, const Json& json) {
    response.set_content(text_of(json), "application/json; charset=utf-8");
}

void refuse(Response& response, int status, const std::string& message) {
    response.status = status;
    answer(response, {{"error", message}});
}

// What a page may not be told by others, and may not be put into another page.
httplib::Headers safe_headers() {
    return {{"Cache-Control", "no-store"},
            {"X-Content-Type-Options", "nosniff"},
            {"X-Frame-Options", "DENY"},
            {"Referrer-Policy", "no-referrer"},
            {"Cross-Origin-Resource-Policy", "same-origin"}};
}

// The library would share the port with whoever else listens there.
void listen_alone(socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

long revision_of(const Request& request) {
    const std::string text = request.get_param_value("after");
    long out = -1;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

// The file's name for people: what is behind the last slash, of a length that can be shown.
std::string name_of(const Request& request) {
    std::string name = request.get_param_value("name");
    name = name.substr(name.find_last_of("/\\") + 1).substr(0, 200);
    if (name.empty()) throw UsageError("the capture needs a name");
    return name;
}

} // namespace

struct Server::Inside {
    Studio& studio;
    httplib::Server http;
    std::string token = random_token(), host;
    int port = 0;
    std::thread listener;
    std::atomic<int> waiting{0};

    Inside(Studio& s, int wanted) : studio(s) {
        http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
        http.set_socket_options(listen_alone);
        http.set_default_headers(safe_headers());
        http.set_payload_max_length(kLargest);
        http.set_keep_alive_timeout(2);
        http.set_tcp_nodelay(true);
        port = wanted ? (http.bind_to_port("127.0.0.1", wanted) ? wanted : -1)
                      : http.bind_to_any_port("127.0.0.1");
        if (port < 0) throw UsageError(fmt::format("port {} cannot be listened on", wanted));
        host = fmt::format("127.0.0.1:{}", port);
        add_routes();
    }

    std::string base() const { return "/" + token + "/"; }

    bool is_ours(const Request& request) const {
        const std::string asked = request.get_header_value("Host");
        const std::string other = fmt::format("localhost:{}", port);
        if (asked != host && asked != other) return false;
        const std::string origin = request.get_header_value("Origin");
        return origin.empty() || origin == "http://" + asked;
    }

    using Work = std::function<void(const Request&, Response&)>;

    httplib::Server::Handler guarded(Work work) const {
        return [this, work = std::move(work)](const Request& request, Response& response) {
            try {
                if (!is_ours(request)) return refuse(response, 403, "not from this page");
                work(request, response);
            } catch (const Json::exception&) {
                refuse(response, 400, kNoAction);
            } catch (const Error& e) {
                refuse(response, 409, e.what());
            } catch (const std::exception& e) {
                refuse(response, 500, std::string("a defect of ours: ") + e.what());
            }
        };
    }

    void get(const std::string& path, Work work) {
        http.Get(base() + path, guarded(std::move(work)));
    }
    void post(const std::string& path, Work work) {
        http.Post(base() + path, guarded(std::move(work)));
    }

    void download(Response& response, const std::string& content, const char* type,
                  const char* name) {
        response.set_header("Content-Disposition",
                            fmt::format("attachment; filename=\"{}\"", name));
        response.set_content(content, type);
    }

    void add_routes() {
        get("", [](const Request&, Response& r) {
            r.set_content(studio_page(), "text/html; charset=utf-8");
        });
        get("api/state", [this](const Request& q, Response& r) {
            const Waiting here(waiting);
            answer(r, studio.state(revision_of(q), here.crowded() ? kCrowded : kPatience));
        });
        get("api/story", [this](const Request&, Response& r) { answer(r, *studio.story()); });
        get("api/model.toml", [this](const Request&, Response& r) {
            download(r, studio.model_toml(), "text/plain; charset=utf-8", "model.toml");
        });
        get("api/report.html", [this](const Request&, Response& r) {
            download(r, report_page(*studio.story()), "text/html; charset=utf-8", "report.html");
        });
        post("api/do", [this](const Request& q, Response& r) {
            const Json action = Json::parse(q.body);
            if (!action.is_object()) return refuse(r, 400, kNoAction);
            answer(r, {{"revision", studio.act(action)}});
        });
        post("api/capture", [this](const Request& q, Response& r) {
            answer(r, {{"revision", studio.add_capture(name_of(q), q.body)}});
        });
    }
};

Server::Server(Studio& studio, int port) : inside_(std::make_unique<Inside>(studio, port)) {}
Server::~Server() { stop(); }

std::string Server::url() const { return "http://" + inside_->host + inside_->base(); }

// The library forgets to stop where it has not begun to listen.
void Server::start() {
    inside_->listener = std::thread([this] { inside_->http.listen_after_bind(); });
    while (!inside_->http.is_running())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Server::stop() {
    if (!inside_->listener.joinable()) return;
    inside_->studio.wake();
    inside_->http.stop();
    inside_->listener.join();
}

} // namespace servoid::studio
