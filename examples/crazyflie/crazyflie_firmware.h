// SPDX-License-Identifier: MIT
// What examples/08_crazyflie.cpp calls of the Crazyflie's firmware: its own headers where they are, else stubs by their
// documentation (the app layer, the peer-to-peer API, log.h, commander.h), with the members that the example uses.
#pragma once

#if __has_include("radiolink.h")
extern "C" {
#include "FreeRTOS.h"
#include "app.h"
#include "commander.h"
#include "configblock.h"
#include "log.h"
#include "queue.h"
#include "radiolink.h"
#include "task.h"
}
#else
#include <cstdint>

extern "C" {
void appMain();

constexpr int P2P_MAX_DATA_SIZE = 60;
struct P2PPacket {
  std::uint8_t size, rssi, port, data[P2P_MAX_DATA_SIZE];
};
void p2pRegisterCB(void (*callback)(P2PPacket*));
bool radiolinkSendP2PPacketBroadcast(P2PPacket* packet);
std::uint64_t configblockGetRadioAddress();

using logVarId_t = std::uint16_t;
logVarId_t logGetVarId(const char* group, const char* name);
float logGetFloat(logVarId_t id);

enum stab_mode_t { modeDisable = 0, modeAbs, modeVelocity };
struct setpoint_t {
  struct {
    float x, y, z;
  } position, velocity;
  struct {
    float roll, pitch, yaw;
  } attitudeRate;
  bool velocity_body;
  struct {
    stab_mode_t x, y, z, roll, pitch, yaw, quat;
  } mode;
};
constexpr int COMMANDER_PRIORITY_EXTRX = 3;
void commanderSetSetpoint(setpoint_t* setpoint, int priority);

using TickType_t = std::uint32_t;
using QueueHandle_t = void*;
constexpr TickType_t M2T(TickType_t milliseconds) { return milliseconds; }
QueueHandle_t xQueueCreate(std::uint32_t length, std::uint32_t item_bytes);
int xQueueSend(QueueHandle_t queue, const void* item, TickType_t wait);
int xQueueReceive(QueueHandle_t queue, void* item, TickType_t wait);
TickType_t xTaskGetTickCount();
void vTaskDelayUntil(TickType_t* woken, TickType_t ticks);
}
#endif
