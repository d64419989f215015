package io.troupe.services.subsumption;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import java.time.Duration;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * The services of a table as an actor interface: a caller names a robot and a service, and the provider drives the
 * robot by it, for as long as the caller holds a lease.
 *
 * <p><b>Role.</b> Implemented by {@link RobotServicesActor}, called through {@link LeasedRobots}, which holds the
 * leases. The same interface is published in one process ({@link SubsumptionRun#start}) and over hosts
 * ({@link RobotNode#offer}), under the name {@value #SERVICE}. Arguments and answers are values: the provider finds
 * services and colours in its own table.
 *
 * <p><b>Order.</b> A robot never has two services. A lease begins with a stamp of the provider, which the caller sends
 * back with {@code drive}, and then with each {@link #renew}. Over hosts it is over {@link #LEASE} after the newest
 * stamp that the provider got back, on the clock of the provider. The stamp was made before the caller got it, so a
 * caller knows without common clocks when a lease is certainly over: {@link #LEASE} after it got the newest stamp that
 * it has sent back. A call that arrives later than that has no effect. In one process caller and provider end together:
 * there a lease is never over, and is not renewed. A newer lease of the same holder replaces the older: its service
 * starts when the other one has stopped, unless it is stopped before that. A call that is cancelled before it has begun
 * has no effect.
 *
 * <p><b>Units and shapes.</b> A {@code robotIndex} is a Player index, from 0; in tables and texts robots are numbered
 * from 1. Colours are {@code 0x00RRGGBB}.
 *
 * <p><b>Errors.</b> A call is rejected if the robot does not exist, if no state of the table has the service, if it is
 * not offered here, if another holder has a lease that is not over, and if the server disconnects. In one process the
 * next service connects again; over hosts the provider stops, so that another one takes over.
 *
 * <p><b>Source.</b> Paper, sections 3.5 and 3.6. The paper starts and stops services by atomic references, which only
 * callers in the same process can share; here a service is stopped by a message.
 */
public interface RobotServices {
    /** The name under which the services are published. */
    String SERVICE = "robotServices";

    /** From the stamp to the end of the lease, over hosts. */
    Duration LEASE = Duration.ofSeconds(2);

    /** For so long after the end of the lease, the provider may send zero speed, and nothing else. */
    Duration HALT = Duration.ofMillis(250);

    /**
     * A time on the monotonic clock of a provider.
     *
     * @param provider differs between providers, and between the lives of one
     */
    record Stamp(long provider, long nanos) {
        /** Of no provider: for leases that are never over. */
        public static final Stamp NONE = new Stamp(0, 0);

        boolean isOf(Stamp other) {
            return provider == other.provider;
        }
    }

    /**
     * The right to drive a robot once.
     *
     * @param holder differs between callers
     * @param number increases with each lease of a holder
     * @param stamp the newest of the provider; only a provider in the same process accepts {@link Stamp#NONE}
     */
    record Lease(long holder, long number, Stamp stamp) {
        Lease renewed(Stamp newer) {
            return new Lease(holder, number, newer);
        }

        boolean isSame(Lease other) {
            return holder == other.holder && number == other.number;
        }
    }

    /**
     * How a service has ended.
     *
     * @param colour the colour that ended the state; empty if the service ended before its robot saw one
     * @param lost the service ended, or did not begin, because its lease was over or replaced, or because its provider
     *     is being closed
     */
    record ServiceEnd(Optional<Integer> colour, boolean lost) {
        static final ServiceEnd LOST = new ServiceEnd(Optional.empty(), true);
    }

    /**
     * The message that a colour finder sends for each colour it sees while its service runs.
     *
     * @param robotIndex of the robot that sees the colour
     * @param colour {@code 0x00RRGGBB}
     * @param secondsInCharge time since the robot's service started to drive it, on the robot's clock
     */
    record ColourReport(int robotIndex, int colour, double secondsInCharge) {}

    /**
     * The answer to a renewal.
     *
     * @param stamp the provider's time now
     * @param held whether a service drives by the lease, or is about to; if not, its call has been answered before
     */
    record Renewal(Stamp stamp, boolean held) {}

    /** The provider's time now. */
    Promise<Stamp> stamp();

    /**
     * Runs a service on a robot until its robot sees a colour that ends the state by the table, its priorities and its
     * hold time, or until {@link #stop}. For a state that is not in the table, every colour that has a state ends it.
     *
     * @param service name of a service of the table
     * @param stateColour the colour of the current state
     * @return fulfilled when the service has stopped
     */
    Promise<ServiceEnd> drive(Lease lease, int robotIndex, String service, int stateColour);

    /**
     * Runs a service on a robot until {@link #stop}, and sends every colour that the robot sees, also those that lead
     * to no state. Black is the colour of all walls, and is sent only if a state of the table has it.
     *
     * @param service name of a service of the table
     * @param reports receives each colour at every reading, as a separate message, in descending order of priority and
     *     then of blob area. If this callback is cancelled the service stops: a robot must not keep driving without an
     *     arbitrator that could stop it.
     * @return fulfilled when the service has stopped
     */
    Promise<ServiceEnd> report(Lease lease, int robotIndex, String service, Callback<ColourReport> reports);

    /** Extends a lease that is not over. */
    Promise<Renewal> renew(Lease lease, int robotIndex);

    /**
     * Stops the service that drives a robot by this lease, at once, without waiting for the next reading; the promise
     * of its call is fulfilled, too. A service that still waits for the previous one to stop does not start.
     *
     * @return fulfilled when the service has stopped and zero speed has been sent; at once if there is none
     */
    Promise<@Nullable Void> stop(Lease lease, int robotIndex);
}
