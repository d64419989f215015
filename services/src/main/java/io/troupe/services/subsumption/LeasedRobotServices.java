package io.troupe.services.subsumption;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import java.time.Duration;
import java.util.Optional;
import org.jspecify.annotations.Nullable;

/**
 * Robot services for callers on other hosts: the same as {@link RobotServices}, but a service drives a robot only while
 * its caller renews a lease. So no robot has two drivers, and none goes on when its arbitrator is gone.
 *
 * <p><b>Order.</b> A lease begins with a stamp of the provider, which the caller sends back with {@code drive}, and
 * then with each {@link #renew}. It is over {@link #LEASE} after the newest stamp that the provider got back, on the
 * clock of the provider. The stamp was made before the caller got it, so a caller knows without common clocks when a
 * lease is certainly over: {@link #LEASE} after it got the newest stamp that it has sent back. A call that arrives
 * later than that has no effect.
 */
interface LeasedRobotServices {
    /** From the stamp to the end of the lease. */
    Duration LEASE = Duration.ofSeconds(2);

    /** For so long after the end of the lease, the provider may send zero speed, and nothing else. */
    Duration HALT = Duration.ofMillis(250);

    /**
     * A time on the monotonic clock of a provider.
     *
     * @param provider differs between providers, and between the lives of one
     */
    record Stamp(long provider, long nanos) {
        boolean isOf(Stamp other) {
            return provider == other.provider;
        }
    }

    /**
     * The right to drive a robot once.
     *
     * @param holder differs between callers
     * @param number increases with each lease of a holder
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
     * @param colour as in {@link RobotServices.ServiceEnd}
     * @param lost the service ended, or did not begin, because its lease was over or its provider is being closed
     */
    record DriveEnd(Optional<Integer> colour, boolean lost) {
        static final DriveEnd LOST = new DriveEnd(Optional.empty(), true);
    }

    /**
     * The answer to a renewal.
     *
     * @param stamp the provider's time now
     * @param held whether a service drives by the lease, or is about to; if not, its call has been answered before
     */
    record Renewal(Stamp stamp, boolean held) {}

    /** The provider's time now. */
    Promise<Stamp> stamp();

    /** As {@link RobotServices#drive(int, String, int)}. */
    Promise<DriveEnd> drive(Lease lease, int robot, String service, int stateColour);

    /** As {@link RobotServices#drive(int, String, Callback)}; fulfilled when the service has stopped. */
    Promise<DriveEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports);

    /** Extends a lease that is not over. */
    Promise<Renewal> renew(Lease lease);

    /** Stops the service that drives by this lease; the promise of its call is fulfilled. */
    Promise<@Nullable Void> stop(Lease lease);
}
