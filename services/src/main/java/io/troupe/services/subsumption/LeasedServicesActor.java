package io.troupe.services.subsumption;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.player.PlayerException;
import io.troupe.services.behaviour.Velocity;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;

/**
 * The robot services of a provider on another host than their caller. Connects to all robots of its table when it is
 * created, and stops when it has lost them, so that another provider takes over.
 */
final class LeasedServicesActor extends RobotServicesActor implements LeasedRobotServices {
    /** A server that is silent for so long has gone: another provider may still reach it. */
    private static final Duration SILENCE_LIMIT = Duration.ofSeconds(2);

    private static final Duration LAST_ANSWERS = Duration.ofMillis(1);

    private final Set<String> offered;
    private final ServiceObserver observer;
    private final SubsumptionTable table;
    private final long incarnation = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
    private final Map<Integer, Drive> drives = new HashMap<>(); // by robot
    private final List<Lease> starting = new ArrayList<>(); // wait until their robot's last service has stopped
    private boolean leaving;

    /**
     * Connects to the robots; on the space of the actor.
     *
     * @throws PlayerException if the robots cannot be reached
     */
    LeasedServicesActor(RobotServicesActor.Settings settings, Set<String> offered) {
        super(settings, SILENCE_LIMIT);
        this.offered = offered;
        this.observer = settings.observer();
        this.table = settings.table();
        connectAll();
    }

    /** A service that drives a robot by a lease. */
    private final class Drive {
        final Lease lease;
        final int robot;
        final String service;
        private long overNanos;
        private boolean lost;

        Drive(Lease lease, int robot, String service) {
            this.lease = lease;
            this.robot = robot;
            this.service = service;
            this.overNanos = overNanos(lease);
        }

        boolean isOver() {
            return nowNanos() - overNanos >= 0;
        }

        boolean mayHalt() {
            return nowNanos() - overNanos < HALT.toNanos();
        }

        void renew(Lease renewed) {
            if (!isOver() && overNanos(renewed) - overNanos > 0) {
                overNanos = overNanos(renewed);
            }
        }

        /** Ends the service when the lease is over. */
        void watch() {
            context().after(Duration.ofNanos(Math.max(0, overNanos - nowNanos())), () -> {
                if (drives.get(robot) != this) {
                    return;
                }
                if (isOver()) {
                    lose();
                } else {
                    watch();
                }
            });
        }

        private Promise<?> lose() {
            lost = true;
            table.service(service).ifPresent(named -> observer.leaseLost(robot, named));
            return LeasedServicesActor.super.stop(robot);
        }
    }

    private long nowNanos() {
        return context().space().clock().nanos();
    }

    private static long overNanos(Lease lease) {
        return lease.stamp().nanos() + LEASE.toNanos();
    }

    private boolean isOver(Lease lease) {
        return lease.stamp().provider() != incarnation || nowNanos() - overNanos(lease) >= 0;
    }

    // ---- calls

    @Override
    public Promise<Stamp> stamp() {
        checkReachable();
        return Promise.of(now());
    }

    private Stamp now() {
        return new Stamp(incarnation, nowNanos());
    }

    private void checkReachable() {
        if (leaving) {
            throw new PlayerException("the robots are not driven from here any more");
        }
    }

    @Override
    public Promise<DriveEnd> drive(Lease lease, int robot, String service, int stateColour) {
        return begin(lease, robot, service, () -> super.drive(robot, service, stateColour));
    }

    @Override
    public Promise<DriveEnd> report(Lease lease, int robot, String service, Callback<ColourReport> reports) {
        return begin(
                lease,
                robot,
                service,
                () -> driveWithReports(robot, service, reports).thenApply(stopped -> new ServiceEnd(Optional.empty())));
    }

    private Promise<DriveEnd> begin(Lease lease, int robot, String service, Supplier<Promise<ServiceEnd>> start) {
        checkReachable();
        if (!offered.contains(service)) {
            throw new IllegalArgumentException(
                    "the service " + service + " is not offered here, expected one of " + String.join(", ", offered));
        }
        Drive before = drives.get(robot);
        if (isOver(lease) || (before != null && isLate(lease, before.lease))) {
            return Promise.of(DriveEnd.LOST);
        }
        if (before != null) {
            if (before.lease.holder() != lease.holder() && !before.isOver()) {
                throw new PlayerException("robot " + (robot + 1) // the caller tries again
                        + " is driven for another arbitrator, whose lease is not over");
            }
            before.lost = true;
            starting.add(lease);
            return super.stop(robot).handle((stopped, error) -> null).thenCompose(free -> {
                drives.remove(robot, before);
                starting.remove(lease);
                return begin(lease, robot, service, start);
            });
        }
        var drive = new Drive(lease, robot, service);
        drives.put(robot, drive);
        Promise<ServiceEnd> end;
        try {
            end = start.get();
        } catch (RuntimeException refused) {
            end = Promise.failed(refused);
        }
        drive.watch();
        return end.whenComplete((ended, error) -> hasEnded(drive, error))
                .thenApply(ended -> new DriveEnd(ended.colour(), drive.lost));
    }

    private static boolean isLate(Lease lease, Lease running) {
        return lease.holder() == running.holder() && lease.number() <= running.number();
    }

    private void hasEnded(Drive drive, @Nullable Throwable error) {
        drives.remove(drive.robot, drive);
        if (error instanceof PlayerException && !leaving) {
            leave().handle((stopped, failed) ->
                    context().after(LAST_ANSWERS, context()::stop)); // other calls are answered first
        }
    }

    @Override
    public Promise<Renewal> renew(Lease lease) {
        boolean held = starting.stream().anyMatch(lease::isSame);
        for (Drive drive : drives.values()) {
            if (drive.lease.isSame(lease) && lease.stamp().provider() == incarnation) {
                drive.renew(lease);
                held = true;
            }
        }
        return Promise.of(new Renewal(now(), held));
    }

    @Override
    public Promise<@Nullable Void> stop(Lease lease) {
        for (Drive drive : drives.values()) {
            if (drive.lease.isSame(lease)) {
                return super.stop(drive.robot);
            }
        }
        return Promise.done();
    }

    // ---- driving

    @Override
    boolean mayCommand(int robot, Velocity velocity) {
        Drive drive = drives.get(robot);
        return drive != null && (!drive.isOver() || (velocity.equals(Velocity.STOP) && drive.mayHalt()));
    }

    /** Stops all services, and starts no more; their callers look for another provider at once. */
    Promise<?> leave() {
        leaving = true;
        List<Promise<?>> stopping = new ArrayList<>();
        List.copyOf(drives.values()).forEach(drive -> {
            drive.lost = true;
            stopping.add(super.stop(drive.robot));
        });
        return Promise.allSettled(stopping);
    }
}
