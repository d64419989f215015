package io.troupe.sim.scenario;

/**
 * One {@code provides} entry of a Player configuration file: which robot answers as which device.
 *
 * @param port TCP port the device is offered on
 * @param interfaceName Player's name: {@code position2d}, {@code sonar}, {@code laser}, {@code ranger},
 *     {@code blobfinder}, {@code simulation}
 * @param index device index, from 0
 * @param model name of the robot; empty for {@code simulation}
 * @param ranger which of the robot's {@link RobotSpec#rangers} answers: for {@code laser}, for {@code ranger}, where it
 *     may be {@link #SONAR_RING}, and for the {@code sonar} of a robot without a ring of its own; else 0
 */
public record DeviceBinding(int port, String interfaceName, int index, String model, int ranger, SourcePosition where) {
    /** As {@link #ranger}: the robot's {@link RobotSpec#sonar}, offered as a ranger. */
    public static final int SONAR_RING = -1;
}
