// SPDX-License-Identifier: MIT
#include "robot_sensors.hpp"

#include "banyan/hosts/argos/readings.hpp"

#if __has_include(<argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>)
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#define BANYAN_HAS_FOOTBOT
#endif
#if __has_include(<argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>)
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>
#define BANYAN_HAS_KHEPERAIV
#endif

namespace banyan::argos {

using namespace ::argos;

namespace {

template <class Sensor> std::function<void(ArgosRobot&)> eyes(Sensor* sensor, const ProximityModel& model) {
  return [sensor, &model](ArgosRobot& robot) {
    for (const auto& reading : sensor->GetReadings())
      if (const auto point = obstacle_at(model, reading.Value, reading.Angle.GetValue())) robot.see(*point);
  };
}

}  // namespace

std::function<void(ArgosRobot&)> eyes_of([[maybe_unused]] CCI_Controller& controller) {
#ifdef BANYAN_HAS_KHEPERAIV
  if (controller.HasSensor("kheperaiv_proximity"))
    return eyes(controller.GetSensor<CCI_KheperaIVProximitySensor>("kheperaiv_proximity"), kheperaiv_proximity);
#endif
#ifdef BANYAN_HAS_FOOTBOT
  if (controller.HasSensor("footbot_proximity"))
    return eyes(controller.GetSensor<CCI_FootBotProximitySensor>("footbot_proximity"), footbot_proximity);
#endif
  return {};
}

std::function<std::optional<Vec2>()> light_of([[maybe_unused]] CCI_Controller& controller,
                                              [[maybe_unused]] const double& intensity_m) {
#ifdef BANYAN_HAS_FOOTBOT
  if (controller.HasSensor("footbot_light")) {
    auto* const sensor = controller.GetSensor<CCI_FootBotLightSensor>("footbot_light");
    return [sensor, &intensity_m]() {
      static thread_local std::vector<LightReading> ring;
      ring.clear();
      for (const auto& reading : sensor->GetReadings()) ring.push_back({reading.Value, reading.Angle.GetValue()});
      return light_at(ring, intensity_m);
    };
  }
#endif
  return {};
}

}  // namespace banyan::argos
