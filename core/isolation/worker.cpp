// SPDX-License-Identifier: Apache-2.0
#include "core/isolation/device_process.h"

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <new>
#include <utility>

#include "core/isolation/shared_memory.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::isolation {
namespace {

class Worker {
public:
    Worker(const Backend& backend, const Channel& channel) : backend_(backend), channel_(channel) {}

    // Executes a request and sends the response. Returns false if the channel has closed.
    bool respond(Packet& packet)
    {
        Deserializer request(std::move(packet.bytes));
        if (packet.descriptor.number() >= 0) {
            locked_ = {};
            memory_ = std::make_unique<SharedMemory>(std::move(packet.descriptor));
        }
        const auto kind = request.take<Request>();
        if (kind == Request::release) {
            renderers_.erase(request.take<int>());
            return true;
        }
        if (kind == Request::cancel) return true;  // the render has already finished
        try {
            Serializer response(Response::done);
            carry_out(kind, request, response);
            return channel_.send(response.bytes());
        } catch (const InputError& error) {
            return refuse(Response::input_error, error.what());
        } catch (const Unavailable& error) {
            return refuse(Response::unavailable, error.what());
        } catch (const DeviceHung& error) {
            return refuse(Response::hung, error.what());
        } catch (const Cancelled& cancelled) {
            return refuse(Response::cancelled, cancelled.what());
        } catch (const std::bad_alloc&) {
            return refuse(Response::no_memory, {});
        } catch (const Error& error) {
            return refuse(Response::error, error.what());
        } catch (const std::exception& error) {
            return refuse(Response::error, fmt::format("backend {}: {}", backend_.name(), error.what()));
        }
    }

private:
    void carry_out(Request kind, Deserializer& request, Serializer& response)
    {
        switch (kind) {
            case Request::list: return list(response);
            case Request::create: {
                const int number = request.take<int>();
                renderers_[number] = backend_.create(request.take<RendererOptions>());
                return;
            }
            case Request::render: return render(request, response);
            case Request::peak: {
                const auto rate = backend_.multiply_add_peak(request.take<RendererOptions>());
                return response(rate.has_value(), rate.value_or(0));
            }
            case Request::release:
            case Request::cancel: return;
        }
    }

    void list(Serializer& response) const
    {
        const auto why = backend_.unavailable();
        response(why.value_or(std::string()), why ? std::vector<Device>() : backend_.devices());
    }

    void render(Deserializer& request, Serializer& response)
    {
        Renderer& renderer = *renderers_.at(request.take<int>());
        const auto layers = request.take<Image::Layers>();
        const int first_row = request.take<int>();
        const int rows = request.take<int>();
        Scene scene;
        transfer(request, scene);
        if (memory_ == nullptr || memory_->size() < shared_size(Image::pixels(scene.width, rows), layers)) {
            throw Error("a device's process has no memory for its picture");
        }
        SharedImage shared(*memory_, scene.width, rows, layers, first_row);
        lock(renderer, shared.image);
        const RenderStats report = renderer.render(scene, shared.image, [&](double share) {
            channel_.send(Serializer(Response::progress, share).bytes());
            // The only request that can arrive during a render is to cancel it.
            if (channel_.waiting()) {
                static_cast<void>(channel_.receive());
                throw Cancelled();
            }
        });
        transfer(response, report);
    }

    // Locks the memory of an image's bytes, which is the same for all pictures until memory_ is replaced. The first
    // picture goes without: locking takes longer than copying it.
    void lock(Renderer& renderer, Image& image)
    {
        const bool first = !std::exchange(locked_.used, true);
        const std::size_t bytes = image.bytes().size();
        if (first || image.has_values() || bytes <= locked_.bytes) return;
        locked_.lock.reset();
        locked_.lock = renderer.lock_memory(image.bytes());
        locked_.bytes = bytes;
    }

    bool refuse(Response kind, const std::string& why) const
    {
        return channel_.send(Serializer(kind, printable(why)).bytes());
    }

    const Backend& backend_;
    const Channel& channel_;
    std::unique_ptr<SharedMemory> memory_;
    struct {
        bool used = false;                     // memory_ has had a picture
        std::size_t bytes = 0;                 // length of the locked part, which begins where memory_ begins
        std::shared_ptr<void> lock = nullptr;  // null: there is none
    } locked_;
    std::map<int, std::unique_ptr<Renderer>> renderers_;
};

}  // namespace

void serve(const Backend& backend, const Channel& channel)
{
    Worker worker(backend, channel);
    for (auto packet = channel.receive(); packet && worker.respond(*packet);) packet = channel.receive();
    std::_Exit(exit_success);  // skips destructors, in which some drivers crash or hang
}

}  // namespace mandelmarch::isolation
