package io.troupe.services.subsumption;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * The services of a table as an actor interface: a caller names a robot and a service, and the provider drives the
 * robot by it.
 *
 * <p><b>Role.</b> Implemented by {@link RobotServicesActor}. {@link SubsumptionRun} publishes it at a broker under the
 * name {@value #SERVICE}, and its {@link Arbitrator} calls it through the broker. Arguments and answers are values: the
 * provider finds services and colours in its own table. The one exception is the callback of {@link #drive(int, String,
 * Callback)}, which a bus over hosts would have to carry.
 *
 * <p><b>Order.</b> A robot never has two services. A service that is called while the robot's previous one is stopping
 * starts when that one has stopped, unless {@link #stop} is called once more before that. A call that is cancelled
 * before it has begun has no effect.
 *
 * <p><b>Units and shapes.</b> Robots by Player index, from 0. Colours are {@code 0x00RRGGBB}.
 *
 * <p><b>Errors.</b> A call is rejected if the robot does not exist, if no state of the table has the service, if the
 * robot's previous service has not been stopped, and if the server disconnects. The next service connects again.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6. The paper starts and stops services by atomic references, which only
 * callers in the same process can share; here a service is stopped by a message.
 */
public interface RobotServices {
    /** The name under which the services are published. */
    String SERVICE = "robotServices";

    /**
     * Runs a service on a robot until its robot sees a colour that ends the state by the table, its priorities and its
     * hold time, or until {@link #stop}. For a state that is not in the table, every colour that has a state ends it.
     *
     * @param service name of a service of the table
     * @param stateColour the colour of the current state
     * @return fulfilled when the service has stopped
     */
    Promise<ServiceEnd> drive(int robot, String service, int stateColour);

    /**
     * Runs a service on a robot until {@link #stop}, and sends every colour that the robot sees, also those that lead
     * to no state. Black is the colour of all walls, and is sent only if a state of the table has it.
     *
     * @param service name of a service of the table
     * @param reports receives each colour at every reading, as a separate message, in descending order of priority and
     *     then of blob area, and the end. If this callback is cancelled the service stops: a robot must not keep
     *     driving without an arbitrator that could stop it.
     */
    void drive(int robot, String service, Callback<ColourReport> reports);

    /**
     * Stops the service of a robot at once, without waiting for the next reading. A service that still waits for the
     * previous one to stop does not start; its call ends as if it had been stopped before it saw a colour.
     *
     * @return fulfilled when the service has stopped and zero speed has been sent; at once if the robot has no service
     */
    Promise<@Nullable Void> stop(int robot);

    /**
     * How a service has ended.
     *
     * @param colour the colour that ended the state; empty if the service was stopped before its robot saw one
     */
    record ServiceEnd(Optional<Integer> colour) {}
}
