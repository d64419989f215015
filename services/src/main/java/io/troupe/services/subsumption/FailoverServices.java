package io.troupe.services.subsumption;

import io.troupe.actor.Actor;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.Timer;
import io.troupe.broker.Broker;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.bus.RemoteFailure;
import io.troupe.player.PlayerException;
import io.troupe.services.subsumption.LeasedRobotServices.DriveEnd;
import io.troupe.services.subsumption.LeasedRobotServices.Lease;
import io.troupe.services.subsumption.LeasedRobotServices.Renewal;
import io.troupe.services.subsumption.LeasedRobotServices.Stamp;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeoutException;
import java.util.function.BiFunction;
import org.jspecify.annotations.Nullable;

/**
 * Robot services on other hosts, for an arbitrator: each through the connection for its service. When a provider is
 * lost, another one continues to drive the robot, in the same state; it is called when the lease of the lost one is
 * certainly over. If there is none for {@link #PATIENCE}, the call is rejected with a {@link MissingServiceException}.
 */
final class FailoverServices extends Actor implements RobotServices {
    private static final Duration PATIENCE = Duration.ofSeconds(5);

    /** Of five renewals in a row, four may be lost or late. */
    private static final Duration RENEW_EVERY = Duration.ofMillis(250);

    private static final Duration STAMP_LIMIT = Duration.ofMillis(500);
    private static final Duration ANSWER_LIMIT = Duration.ofSeconds(1); // of renewals and stops
    private static final Duration PAUSE = Duration.ofMillis(100); // between two attempts

    /** From the stamp's arrival here to the time when the provider certainly commands nothing more. */
    static final Duration CERTAINLY_OVER =
            LeasedRobotServices.LEASE.plus(LeasedRobotServices.HALT).plusMillis(50);

    private final Map<String, LeasedRobotServices> byService;
    private final Broker broker;
    private final HostedRun.Listener listener;
    private final long holder = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
    private final Map<Integer, Drive> drives = new HashMap<>(); // by robot
    private long leases;

    FailoverServices(Map<String, LeasedRobotServices> byService, Broker broker, HostedRun.Listener listener) {
        this.byService = byService;
        this.broker = broker;
        this.listener = listener;
    }

    private long nowNanos() {
        return context().space().clock().nanos();
    }

    // ---- calls

    @Override
    public Promise<ServiceEnd> drive(int robot, String service, int stateColour) {
        return begin(robot, service, (provider, lease) -> provider.drive(lease, robot, service, stateColour), null)
                .thenApply(ServiceEnd::new);
    }

    @Override
    public void drive(int robot, String service, Callback<ColourReport> reports) {
        begin(robot, service, (provider, lease) -> provider.report(lease, robot, service, passingOn(reports)), reports)
                .handle((end, error) -> {
                    if (error == null) {
                        reports.finish();
                    } else {
                        reports.fail(error);
                    }
                    return null;
                });
    }

    /** A callback stays with one provider, and its end is that of the call. */
    private static Callback<ColourReport> passingOn(Callback<ColourReport> reports) {
        return new Callback.Stream<>(reports::next, end -> {});
    }

    private Promise<Optional<Integer>> begin(
            int robot,
            String service,
            BiFunction<LeasedRobotServices, Lease, Promise<DriveEnd>> call,
            @Nullable Callback<ColourReport> reports) {
        LeasedRobotServices provider = byService.get(service);
        if (provider == null) {
            throw new IllegalArgumentException(
                    "there is no service " + service + ", expected one of " + String.join(", ", byService.keySet()));
        }
        Drive before = drives.get(robot);
        if (before != null) {
            throw new IllegalStateException("robot " + (robot + 1) + " is in the charge of " + before.service
                    + " and was to get " + service + ": stop the first before");
        }
        var drive = new Drive(robot, service, provider, call, reports);
        drives.put(robot, drive);
        drive.attempt();
        return drive.ended;
    }

    @Override
    public Promise<@Nullable Void> stop(int robot) {
        Drive drive = drives.get(robot);
        return drive == null ? Promise.done() : drive.stop();
    }

    // ---- one service that drives one robot, by one provider after the other

    private final class Drive {
        final String service;
        final Deferred<Optional<Integer>> ended = new Deferred<>();
        private final int robot;
        private final LeasedRobotServices provider; // the current one of the connection
        private final BiFunction<LeasedRobotServices, Lease, Promise<DriveEnd>> call;
        private final @Nullable Callback<ColourReport> reports;
        private @Nullable Attempt current;
        private @Nullable Timer waiting;
        private long waitsSinceNanos;
        private boolean waits; // for a provider
        private boolean extended; // the patience, because a provider was found at its end
        private boolean stopping;

        Drive(
                int robot,
                String service,
                LeasedRobotServices provider,
                BiFunction<LeasedRobotServices, Lease, Promise<DriveEnd>> call,
                @Nullable Callback<ColourReport> reports) {
            this.robot = robot;
            this.service = service;
            this.provider = provider;
            this.call = call;
            this.reports = reports;
        }

        void attempt() {
            waiting = null;
            var attempt = new Attempt(this);
            current = attempt;
            attempt.begin();
        }

        Promise<@Nullable Void> stop() {
            stopping = true;
            if (current != null) {
                current.stop();
            }
            if (waiting != null && current == null) {
                waiting.cancel();
                end(Optional.empty());
            }
            return ended.handle((end, error) -> null);
        }

        void end(Optional<Integer> colour) {
            drives.remove(robot, this);
            ended.resolve(colour);
        }

        private void fail(Throwable error) {
            drives.remove(robot, this);
            ended.reject(error);
        }

        /** The provider has begun, and goes on. */
        void drives() {
            if (waits) {
                waits = false;
                extended = false;
                listener.drivenAgain(robot, service);
            }
        }

        /** The provider is gone, but may still drive until its lease is over. */
        void waits(Throwable why) {
            if (!waits && !stopping) {
                waits = true;
                waitsSinceNanos = nowNanos();
                listener.driverLost(robot, service, why);
            }
        }

        /** An attempt has ended without the end of the service; no provider drives the robot now. */
        void lost(Throwable why) {
            current = null;
            if (stopping) {
                end(Optional.empty());
                return;
            }
            if (!isLossOfProvider(why)) {
                fail(why);
                return;
            }
            waits(why);
            if (patienceLeft().compareTo(PAUSE) > 0) {
                waiting = context().after(PAUSE, this::attempt);
            } else {
                findLast(why);
            }
        }

        private Duration patienceLeft() {
            return waits ? PATIENCE.minusNanos(nowNanos() - waitsSinceNanos) : PATIENCE;
        }

        Duration stampLimit() {
            long leftNanos = patienceLeft().toNanos();
            return Duration.ofNanos(Math.clamp(leftNanos, PAUSE.toNanos(), STAMP_LIMIT.toNanos()));
        }

        /** A provider that is being started slowly is found here; else the error names what there is. */
        private void findLast(Throwable why) {
            broker.require(Need.ofCapability(SubsumptionRun.CALLER, service)).handle((found, missing) -> {
                if (stopping) {
                    end(Optional.empty());
                } else if (missing != null) {
                    fail(missing);
                } else if (extended) {
                    fail(why);
                } else {
                    extended = true;
                    waitsSinceNanos = nowNanos();
                    attempt();
                }
                return null;
            });
        }
    }

    private static boolean isLossOfProvider(Throwable error) {
        return error instanceof ServiceCallException
                || error instanceof TimeoutException
                || error instanceof PlayerException
                || (error instanceof RemoteFailure failure && failure.type().equals(PlayerException.class.getName()));
    }

    /** One call of one provider, with its lease. */
    private final class Attempt {
        private final Drive drive;
        private @Nullable Lease lease;
        private @Nullable Promise<DriveEnd> running;
        private long stampedNanos; // when the newest stamp arrived
        private long overNanos; // when the provider certainly commands nothing more
        private boolean ended;
        private boolean unanswered; // and nothing is renewed: the lease runs out

        Attempt(Drive drive) {
            this.drive = drive;
        }

        void begin() {
            drive.provider.stamp().orTimeout(drive.stampLimit()).handle((stamp, error) -> {
                if (error != null || drive.stopping) {
                    ended = true;
                    drive.lost(error == null ? new TimeoutException("stopped") : error);
                } else {
                    call(stamp);
                }
                return null;
            });
        }

        private void call(Stamp stamp) {
            var first = new Lease(holder, ++leases, stamp);
            lease = first;
            stampedNanos = nowNanos();
            overNanos = stampedNanos + CERTAINLY_OVER.toNanos();
            Promise<DriveEnd> end = drive.call.apply(drive.provider, first);
            running = end;
            end.handle((how, error) -> {
                if (!ended) {
                    hasEnded(how, error);
                }
                return null;
            });
            renewLater();
        }

        private void hasEnded(@Nullable DriveEnd how, @Nullable Throwable error) {
            if (error instanceof ServiceCallException unanswered && unanswered.mayHaveRun()) {
                awaitOver(unanswered); // it may drive until its lease is over
                return;
            }
            ended = true;
            if (how != null && (drive.stopping || how.colour().isPresent())) {
                drive.current = null;
                drive.end(how.colour());
            } else {
                drive.lost(error != null ? error : new TimeoutException("its lease was not renewed in time"));
            }
        }

        /** Renews the lease, until the call has ended or is unanswered for so long that the lease is over. */
        private void renewLater() {
            context().after(RENEW_EVERY, () -> {
                Lease held = lease;
                if (ended || unanswered || held == null) {
                    return;
                }
                if (nowNanos() - overNanos >= 0) {
                    giveUp(new TimeoutException("the lease could not be renewed"));
                    return;
                }
                if (drive.reports != null && drive.reports.isCancelled()) {
                    drive.stopping = true;
                    stop();
                }
                if (!drive.stopping) {
                    renew(held);
                }
                renewLater();
            });
        }

        private void renew(Lease held) {
            overNanos = stampedNanos + CERTAINLY_OVER.toNanos();
            drive.provider.renew(held).orTimeout(ANSWER_LIMIT).handle((renewal, error) -> {
                if (!ended && !unanswered && renewal != null) {
                    renewed(held, renewal);
                }
                return null;
            });
        }

        private void renewed(Lease held, Renewal renewal) {
            if (!renewal.stamp().isOf(held.stamp())) {
                return; // the connection has another provider, and the lease runs out
            }
            if (!renewal.held()) {
                giveUp(new TimeoutException("it has ended, and the answer was lost"));
            } else {
                lease = held.renewed(renewal.stamp());
                stampedNanos = nowNanos();
                drive.drives();
            }
        }

        void stop() {
            Lease held = lease;
            if (held != null && !ended) {
                drive.provider.stop(held).orTimeout(ANSWER_LIMIT).handle((stopped, error) -> null);
            }
        }

        private void awaitOver(Throwable why) {
            running = null;
            unanswered = true;
            drive.waits(why);
            context().after(Duration.ofNanos(Math.max(0, overNanos - nowNanos())), () -> {
                if (!ended) {
                    giveUp(why);
                }
            });
        }

        private void giveUp(Throwable why) {
            ended = true;
            if (running != null) {
                running.cancel();
            }
            drive.lost(why);
        }
    }
}
