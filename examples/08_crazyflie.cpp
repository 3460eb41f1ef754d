// SPDX-License-Identifier: MIT
// Caravan on Crazyflies, as an app of their firmware: their own radio, no ground station. Each knows where it is in a
// common frame (Lighthouse, LPS, motion capture) and says so beside its message. See crazyflie/README.md.
#include <cstring>

#include "banyan/controller/caravan/caravan.hpp"
#include "banyan/controller/core/wire.hpp"
#include "crazyflie/crazyflie_firmware.h"
using namespace banyan;

constexpr float range_m = 2.0F, v_max_m_s = 0.3F, height_m = 0.5F, degree = pi<float> / 180.0F;
constexpr Platform crazyflie{range_m, 0.1F, v_max_m_s, 0.1F, 0.1F, false, Drive::holonomic};
constexpr Vec2 targets[] = {{}, {3.0F, 0.5F}, {-3.0F, 0.0F}};  // of robots 1 and 2; robot 0 is the root
struct Said {
  Vec2 place;
  std::uint8_t message[wire_size<caravan::Message>()];
};
static_assert(sizeof(Said) <= 57, "a packet has 60 bytes, of which 57 are safe");
static QueueHandle_t inbox;  // NOLINT(*-avoid-non-const-global-variables): for the radio's callback

extern "C" void appMain() {
  const auto id = static_cast<RobotId>(configblockGetRadioAddress() & 0xFF);
  const logVarId_t log[] = {logGetVarId("stateEstimate", "x"), logGetVarId("stateEstimate", "y"),
                            logGetVarId("stateEstimate", "yaw")};
  static caravan::State state = caravan::initial(id, id == 1 || id == 2, id == 0);  // the app's stack is small
  static caravan::Message messages[16];
  caravan::Params params;
  static_cast<Machine&>(params) = machine_of(crazyflie);
  inbox = xQueueCreate(16, sizeof(Said));
  p2pRegisterCB([](P2PPacket* packet) {  // on the radio's task; another size: cut short, or of another app
    if (packet->size == sizeof(Said)) xQueueSend(inbox, packet->data, 0);
  });
  Said said{{logGetFloat(log[0]), logGetFloat(log[1])}, {}};
  float yaw = degree * logGetFloat(log[2]);
  for (TickType_t woken = xTaskGetTickCount();; vTaskDelayUntil(&woken, M2T(100))) {
    const Vec2 here{logGetFloat(log[0]), logGetFloat(log[1])};
    const Vec2 moved = rotate_back(unit_vector(yaw), here - said.place);
    Senses senses{.odometry = {moved.x, moved.y, degree * logGetFloat(log[2]) - yaw}};
    yaw += senses.odometry.turn_rad;
    const auto seen = [&](Vec2 place) { return rotate_back(unit_vector(yaw), place - here); };
    caravan::Heard heard[16];
    std::size_t count = 0;
    while (count < 16 && xQueueReceive(inbox, &said, 0)) {
      const auto message = decode_fields<caravan::Message>(said.message);
      if (!message || distance(here, said.place) > range_m) continue;
      std::size_t k = 0;
      while (k < count && messages[k].id != message->id) ++k;  // the newest of each counts
      messages[k] = *message;
      heard[k] = {&messages[k], seen(said.place)};
      count += k == count ? 1 : 0;
    }
    if (id == 1 || id == 2) senses.orders = {.sent = true, .target = seen(targets[id])};
    const auto output = caravan::step(params, state, {std::span(heard, count), senses, crazyflie});
    encode_fields(output.message, said.message);
    said.place = here;
    P2PPacket packet{};
    packet.size = sizeof said;
    std::memcpy(packet.data, &said, sizeof said);
    radiolinkSendP2PPacketBroadcast(&packet);
    const Velocity velocity = velocity_of(output.motion, crazyflie);
    setpoint_t wanted{};
    wanted.mode.x = wanted.mode.y = wanted.mode.yaw = modeVelocity;
    wanted.mode.z = modeAbs, wanted.position.z = height_m, wanted.velocity_body = true;
    wanted.velocity.x = velocity.forward_m_s, wanted.velocity.y = velocity.sideways_m_s;
    commanderSetSetpoint(&wanted, COMMANDER_PRIORITY_EXTRX);
  }
}
