package io.troupe.sim.model;

import io.troupe.common.text.SourcePosition;

/**
 * One {@code provides} entry of a Player configuration file: a device address and the robot that answers for it.
 *
 * @param port TCP port on which the device is offered
 * @param interfaceName Player's name: {@code position2d}, {@code sonar}, {@code laser}, {@code ranger},
 *     {@code blobfinder}, {@code simulation}, or that of a {@link DeviceSpec}
 * @param index device index, from 0
 * @param model name of the robot; empty for {@code simulation}
 * @param ranger index into the robot's {@link RobotSpec#rangers} for {@code laser}, for {@code ranger} (or
 *     {@link #SONAR_RING}), and for the {@code sonar} of a robot without a sonar ring; into {@link RobotSpec#devices}
 *     for these devices; else 0
 */
public record DeviceBinding(int port, String interfaceName, int index, String model, int ranger, SourcePosition where) {
    /** Value of {@link #ranger} for the robot's {@link RobotSpec#sonar}, offered as a ranger. */
    public static final int SONAR_RING = -1;
}
