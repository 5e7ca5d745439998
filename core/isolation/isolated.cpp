// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/isolated.h"

#include <fmt/format.h>

#include <atomic>
#include <map>
#include <mutex>

#include "core/isolation/device_process.h"
#include "core/isolation/shared_memory.h"
#include "core/render/registry.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

using namespace isolation;

// A device: its process, if a renderer uses one, and the shared memory for its pictures.
class Host {
public:
    Host(std::shared_ptr<const ForkServer> fork_server, std::string name)
        : fork_server_(std::move(fork_server)), name_(std::move(name))
    {
    }

    // Returns the running process; starts one if none runs. Throws Error if the device was given up.
    std::shared_ptr<DeviceProcess> process()
    {
        const std::scoped_lock lock(mutex_);
        if (!given_up_.empty()) throw Error(given_up_);
        auto found = process_.lock();
        if (found == nullptr || found->has_ended()) {
            process_ = found = std::make_shared<DeviceProcess>(fork_server_, name_);
            memory_.reset();
        }
        return found;
    }

    // Renders a picture as `request` specifies. Calls of a device's renderers are executed one after the other.
    RenderStats draw(DeviceProcess& process, const Serializer& request, Image& image, const Progress& progress)
    {
        const std::scoped_lock lock(drawing_);
        const auto layers = image.has_values() ? Image::Layers::all : Image::Layers::bytes;
        const std::size_t size = shared_size(image.pixels(), layers);
        const bool fits = memory_ != nullptr && memory_->size() >= size && memory_->size() / most_spare <= size;
        if (!fits) {
            memory_.reset();
            memory_ = std::make_unique<SharedMemory>(size);
        }
        Deserializer response = process.request(request, "drawing", fits ? -1 : memory_->descriptor(), progress);
        RenderStats report;
        transfer(response, report);
        copy_shared(*memory_, image);
        return report;
    }

    // Calls `body`. If the device hangs, gives it up, because each further call would wait as long.
    template <class Body>
    auto guarded(const Body& body)
    {
        try {
            return body();
        } catch (const DeviceHung& hung) {
            const std::scoped_lock lock(mutex_);
            given_up_ = fmt::format("{}: it did not answer before and was given up", name_);
            throw Error(hung.what());
        }
    }

    int next_number() { return numbers_++; }

private:
    static constexpr std::size_t most_spare = 64;  // shared memory over this many times the size needed is replaced

    std::shared_ptr<const ForkServer> fork_server_;
    std::string name_;
    std::weak_ptr<DeviceProcess> process_;
    std::unique_ptr<SharedMemory> memory_;  // mapped by the device process, too
    std::string given_up_;                  // why the device was given up; empty: it is in use
    std::atomic<int> numbers_ = 0;          // number of the next renderer
    std::mutex mutex_;
    std::mutex drawing_;
};

class IsolatedRenderer : public Renderer {
public:
    IsolatedRenderer(std::shared_ptr<Host> host, const RendererOptions& options)
        : host_(std::move(host)), options_(options), number_(host_->next_number())
    {
        host_->guarded([&] { create(); });
    }

    ~IsolatedRenderer() override
    {
        if (process_ == nullptr) return;
        process_->send(Serializer(Request::release, number_));
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        return host_->guarded([&] {
            // If the driver has crashed, perhaps in a call of another renderer, the process has ended.
            if (process_->has_ended()) create();
            Serializer request(Request::render, number_, image.has_values() ? Image::Layers::all : Image::Layers::bytes,
                               image.first_row(), image.height());
            transfer(request, scene);
            return host_->draw(*process_, request, image, progress);
        });
    }

private:
    void create()
    {
        process_ = host_->process();
        process_->request(Serializer(Request::create, number_, options_), "opening the device");
    }

    std::shared_ptr<Host> host_;
    RendererOptions options_;
    int number_;
    std::shared_ptr<DeviceProcess> process_;
};

class IsolatedBackend : public Backend {
public:
    explicit IsolatedBackend(std::unique_ptr<Backend> backend)
        : backend_(std::move(backend)),
          fork_server_(std::make_shared<ForkServer>([this](const Channel& channel) { serve(*backend_, channel); }))
    {
    }

    std::string_view name() const override { return backend_->name(); }
    BackendInfo info() const override { return backend_->info(); }
    std::vector<InstalledDriver> installed_drivers() const override { return backend_->installed_drivers(); }

    std::optional<std::string> unavailable() const override
    {
        const Listing& found = listing();
        return found.unavailable.empty() ? std::nullopt : std::optional(found.unavailable);
    }

    std::vector<Device> devices() const override { return listing().devices; }

    bool draws(const Scene& scene) const override { return backend_->draws(scene); }

    // The device process runs the trials.
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        return std::make_unique<IsolatedRenderer>(host(options.device), options);
    }
    bool runs_trials() const override { return true; }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        const auto device = host(options.device);
        return device->guarded([&] {
            Deserializer response =
                device->process()->request(Serializer(Request::peak, options), "measuring the multiply-add peak");
            const bool known = response.take<bool>();
            const auto rate = response.take<double>();
            return known ? std::optional(rate) : std::nullopt;
        });
    }

private:
    // Lists the devices on the first call, in a process that then ends. Throws Error if the driver fails.
    const Listing& listing() const
    {
        const std::scoped_lock lock(mutex_);
        if (!listing_) {
            Listing& found = listing_.emplace();
            try {
                DeviceProcess process(fork_server_, fmt::format("backend {}", name()));
                Deserializer response = process.request(Serializer(Request::list), "listing devices");
                response(found.unavailable, found.devices);
            } catch (const Error& error) {
                found.failure = error.what();
            }
        }
        if (!listing_->failure.empty()) throw Error(listing_->failure);
        return *listing_;
    }

    std::shared_ptr<Host> host(int device) const
    {
        const std::scoped_lock lock(mutex_);
        std::shared_ptr<Host>& found = hosts_[device];
        if (found == nullptr) {
            found = std::make_shared<Host>(fork_server_, fmt::format("backend {}: device {}", name(), device));
        }
        return found;
    }

    std::unique_ptr<Backend> backend_;
    std::shared_ptr<const ForkServer> fork_server_;
    mutable std::mutex mutex_;
    mutable std::optional<Listing> listing_;
    mutable std::map<int, std::shared_ptr<Host>> hosts_;
};

}  // namespace

std::unique_ptr<Backend> isolated(std::unique_ptr<Backend> backend)
{
    return std::make_unique<IsolatedBackend>(std::move(backend));
}

}  // namespace mandelmarch
