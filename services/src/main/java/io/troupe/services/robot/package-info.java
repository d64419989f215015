/**
 * The robots of a Player server, as services and components use them. Start with
 * {@link io.troupe.services.robot.RobotConnection}. {@link io.troupe.services.robot.PlayerRobot} reads the sensors of
 * one robot and drives it; {@link io.troupe.services.robot.ControlCycle} is the 100 ms cycle of a behaviour.
 */
@NullMarked
package io.troupe.services.robot;

import org.jspecify.annotations.NullMarked;
