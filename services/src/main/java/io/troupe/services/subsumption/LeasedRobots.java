package io.troupe.services.subsumption;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.broker.Broker;
import io.troupe.broker.MissingServiceException;
import io.troupe.broker.Need;
import io.troupe.broker.ServiceCallException;
import io.troupe.bus.RemoteFailure;
import io.troupe.player.PlayerException;
import io.troupe.services.subsumption.RobotServices.ColourReport;
import io.troupe.services.subsumption.RobotServices.Lease;
import io.troupe.services.subsumption.RobotServices.Renewal;
import io.troupe.services.subsumption.RobotServices.ServiceEnd;
import io.troupe.services.subsumption.RobotServices.Stamp;
import java.security.SecureRandom;
import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;

/**
 * The robots of an arbitrator, with the leases by which {@link RobotServices} drive them.
 *
 * {@snippet :
 * var robots = LeasedRobots.of(services);
 * robots.drive(0, "spaceWanderer", NamedColours.BLUE).then(colour -> show(colour));
 * robots.stop(0);
 * }
 *
 * <p><b>Role.</b> Each service has a connection to its provider. Over hosts the leases are renewed, and when a provider
 * is lost, another one continues to drive the robot, in the same state; it is called when the lease of the lost one is
 * certainly over. If there is none for 5 s, the call is rejected with a {@link MissingServiceException}. In one process
 * leases are never over, and a provider that is lost ends the call.
 *
 * <p><b>Threads.</b> One actor space; usually the turns of one actor.
 *
 * <p><b>Order.</b> A robot never has two services. A service that is called while the robot's previous one is stopping
 * starts when that one has stopped, unless {@link #stop} is called once more before that.
 *
 * <p><b>Units and shapes.</b> A {@code robotIndex} is a Player index, from 0. Colours are {@code 0x00RRGGBB}.
 */
public final class LeasedRobots {
    /** Notified of who drives, over hosts. On the space's thread. */
    public interface Listener {
        /** The provider that drives a robot is gone, and another one is looked for; it is not a change of state. */
        default void driverLost(int robotIndex, String service, Throwable why) {}

        /** A robot is driven again. */
        default void drivenAgain(int robotIndex, String service) {}
    }

    /** The providers are on other hosts. */
    private record Hosts(ActorSpace space, Broker broker, Listener listener) {
        long nowNanos() {
            return space.clock().nanos();
        }
    }

    private static final Duration PATIENCE = Duration.ofSeconds(5);

    /** Of five renewals in a row, four may be lost or late. */
    private static final Duration RENEW_EVERY = Duration.ofMillis(250);

    private static final Duration STAMP_LIMIT = Duration.ofMillis(500);
    private static final Duration ANSWER_LIMIT = Duration.ofSeconds(1); // of renewals and stops
    private static final Duration PAUSE = Duration.ofMillis(100); // between two attempts

    /** From the stamp's arrival here to the time when the provider certainly commands nothing more. */
    static final Duration CERTAINLY_OVER =
            RobotServices.LEASE.plus(RobotServices.HALT).plusMillis(50);

    private final Map<String, RobotServices> byService;
    private final @Nullable RobotServices others; // for services that byService does not have
    private final @Nullable Hosts hosts;
    private final long holder = new SecureRandom().nextLong(1, 1L << 53); // exact in every language
    private final Map<Integer, Drive> drives = new HashMap<>(); // by robot; the last one
    private long leases;

    private LeasedRobots(Map<String, RobotServices> byService, @Nullable RobotServices others, @Nullable Hosts hosts) {
        this.byService = new LinkedHashMap<>(byService);
        this.others = others;
        this.hosts = hosts;
    }

    /** The robots of a provider in this process. */
    public static LeasedRobots of(RobotServices services) {
        return new LeasedRobots(Map.of(), services, null);
    }

    /** The robots of providers in this process, which are called through one connection for each service. */
    static LeasedRobots of(Map<String, RobotServices> byService) {
        return new LeasedRobots(byService, null, null);
    }

    /**
     * The robots of providers on other hosts.
     *
     * @param space the one on which the robots are driven
     */
    static LeasedRobots overHosts(
            Map<String, RobotServices> byService, ActorSpace space, Broker broker, Listener listener) {
        return new LeasedRobots(byService, null, new Hosts(space, broker, listener));
    }

    // ---- calls

    /**
     * As {@link RobotServices#drive}.
     *
     * @return fulfilled with the colour that ended the service; empty if it was stopped before its robot saw one
     */
    public Promise<Optional<Integer>> drive(int robotIndex, String service, int stateColour) {
        return begin(robotIndex, service, (provider, lease) -> provider.drive(lease, robotIndex, service, stateColour));
    }

    /**
     * As {@link RobotServices#report}.
     *
     * @return fulfilled when the service has stopped
     */
    public Promise<?> report(int robotIndex, String service, Consumer<ColourReport> reports) {
        return begin(robotIndex, service, (provider, lease) -> {
            var ofThisProvider = new Callback.Stream<ColourReport>(reports, end -> {}); // the end is that of the call
            return provider.report(lease, robotIndex, service, ofThisProvider);
        });
    }

    private Promise<Optional<Integer>> begin(int robot, String service, Call call) {
        RobotServices provider = byService.getOrDefault(service, others);
        if (provider == null) {
            throw new IllegalArgumentException(
                    "there is no service " + service + ", expected one of " + String.join(", ", byService.keySet()));
        }
        Drive before = drives.get(robot);
        if (before != null && !before.stopping) {
            throw new IllegalStateException("robot " + (robot + 1) + " is in the charge of " + before.service
                    + " and was to get " + service + ": stop the first before");
        }
        var drive = new Drive(robot, service, provider, call);
        drives.put(robot, drive);
        if (before == null) {
            drive.attempt();
        } else {
            before.ended.onSettled((end, error) -> {
                drive.attempt();
            });
        }
        return drive.ended;
    }

    /**
     * Stops the service of a robot at once, without waiting for the next reading. A service that still waits for the
     * previous one to stop does not start; its call ends as if it had been stopped before it saw a colour.
     *
     * @return settled when the service has ended; fulfilled at once if the robot has no service
     */
    public Promise<@Nullable Void> stop(int robotIndex) {
        Drive drive = drives.get(robotIndex);
        return drive == null ? Promise.done() : drive.stop();
    }

    // ---- one service that drives one robot, by one provider after the other

    /** A call of a provider. */
    @FunctionalInterface
    private interface Call {
        Promise<ServiceEnd> of(RobotServices provider, Lease lease);
    }

    private final class Drive {
        final Deferred<Optional<Integer>> ended = new Deferred<>();
        private final int robot;
        private final String service;
        private final RobotServices provider; // the current one of the connection
        private final Call call;
        private @Nullable Attempt current;
        private @Nullable Long lostNanos; // waits for a provider since then
        private boolean extended; // the patience, because a provider was found at its end
        private boolean stopping;

        Drive(int robot, String service, RobotServices provider, Call call) {
            this.robot = robot;
            this.service = service;
            this.provider = provider;
            this.call = call;
        }

        void attempt() {
            if (stopping) {
                end(Optional.empty());
            } else if (hosts == null) {
                call(Stamp.NONE);
            } else {
                provider.stamp().orTimeout(stampLimit(hosts)).onSettled((stamp, error) -> {
                    if (error == null && !stopping) {
                        call(stamp);
                    } else {
                        lost(error == null ? new TimeoutException("stopped") : error);
                    }
                });
            }
        }

        private void call(Stamp stamp) {
            var attempt = new Attempt(this, new Lease(holder, ++leases, stamp));
            current = attempt;
            attempt.begin();
        }

        Promise<@Nullable Void> stop() {
            stopping = true;
            if (current != null) {
                current.stop();
            }
            return ended.thenApply(end -> null);
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
        void drives(Hosts over) {
            if (lostNanos != null) {
                lostNanos = null;
                extended = false;
                over.listener.drivenAgain(robot, service);
            }
        }

        /** The provider is gone, but may still drive until its lease is over. */
        void waits(Hosts over, Throwable why) {
            if (lostNanos == null && !stopping) {
                lostNanos = over.nowNanos();
                over.listener.driverLost(robot, service, why);
            }
        }

        /** An attempt has ended without the end of the service; no provider drives the robot now. */
        void lost(Throwable why) {
            current = null;
            if (hosts == null) {
                fail(why);
            } else if (stopping) {
                end(Optional.empty());
            } else if (!isLossOfProvider(why)) {
                fail(why);
            } else {
                waits(hosts, why);
                if (patienceLeft(hosts).compareTo(PAUSE) > 0) {
                    hosts.space.delay(PAUSE).thenRun(this::attempt);
                } else {
                    findLast(hosts, why);
                }
            }
        }

        private Duration patienceLeft(Hosts over) {
            return lostNanos == null ? PATIENCE : PATIENCE.minusNanos(over.nowNanos() - lostNanos);
        }

        private Duration stampLimit(Hosts over) {
            long leftNanos = patienceLeft(over).toNanos();
            return Duration.ofNanos(Math.clamp(leftNanos, PAUSE.toNanos(), STAMP_LIMIT.toNanos()));
        }

        /** A provider that is being started slowly is found here; else the error names what there is. */
        private void findLast(Hosts over, Throwable why) {
            over.broker
                    .require(Need.ofCapability(SubsumptionRun.CALLER, service))
                    .onSettled((found, missing) -> {
                        if (stopping) {
                            end(Optional.empty());
                        } else if (missing != null) {
                            fail(missing);
                        } else if (extended) {
                            fail(why);
                        } else {
                            extended = true;
                            lostNanos = over.nowNanos();
                            attempt();
                        }
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
        private Lease lease;
        private Promise<ServiceEnd> running = new Deferred<>(); // until it has begun
        private long stampedNanos; // when the newest stamp arrived
        private long overNanos; // when the provider certainly commands nothing more
        private boolean ended;
        private boolean unanswered; // and nothing is renewed: the lease runs out

        Attempt(Drive drive, Lease lease) {
            this.drive = drive;
            this.lease = lease;
        }

        void begin() {
            running = drive.call.of(drive.provider, lease);
            running.onSettled((how, error) -> {
                if (!ended) {
                    hasEnded(how, error);
                }
            });
            if (hosts != null) {
                stampedNanos = hosts.nowNanos();
                overNanos = stampedNanos + CERTAINLY_OVER.toNanos();
                renewLater(hosts);
            }
        }

        private void hasEnded(@Nullable ServiceEnd how, @Nullable Throwable error) {
            if (hosts != null && error instanceof ServiceCallException sent && sent.mayHaveRun()) {
                awaitOver(hosts, sent); // it may drive until its lease is over
                return;
            }
            ended = true;
            if (how != null && (drive.stopping || !how.lost())) {
                drive.end(how.colour());
            } else {
                drive.lost(error != null ? error : new TimeoutException("its lease was not renewed in time"));
            }
        }

        /** Renews the lease, until the call has ended or is unanswered for so long that the lease is over. */
        private void renewLater(Hosts over) {
            over.space.delay(RENEW_EVERY).thenRun(() -> {
                if (ended || unanswered) {
                    return;
                }
                if (over.nowNanos() - overNanos >= 0) {
                    giveUp(new TimeoutException("the lease could not be renewed"));
                    return;
                }
                if (!drive.stopping) {
                    renew(over);
                }
                renewLater(over);
            });
        }

        private void renew(Hosts over) {
            overNanos = stampedNanos + CERTAINLY_OVER.toNanos();
            drive.provider.renew(lease, drive.robot).orTimeout(ANSWER_LIMIT).onSettled((renewal, error) -> {
                if (!ended && !unanswered && renewal != null) {
                    renewed(over, renewal);
                }
            });
        }

        private void renewed(Hosts over, Renewal renewal) {
            if (!renewal.stamp().isOf(lease.stamp())) {
                return; // the connection has another provider, and the lease runs out
            }
            if (!renewal.held()) {
                giveUp(new TimeoutException("it has ended, and the answer was lost"));
            } else {
                lease = lease.renewed(renewal.stamp());
                stampedNanos = over.nowNanos();
                drive.drives(over);
            }
        }

        void stop() {
            if (!ended) { // the answer is not used, the end of the call is
                Promise<?> answer = drive.provider.stop(lease, drive.robot);
                (hosts == null ? answer : answer.orTimeout(ANSWER_LIMIT)).onRejected(error -> {});
            }
        }

        private void awaitOver(Hosts over, Throwable why) {
            unanswered = true;
            drive.waits(over, why);
            over.space
                    .delay(Duration.ofNanos(Math.max(0, overNanos - over.nowNanos())))
                    .thenRun(() -> {
                        if (!ended) {
                            giveUp(why);
                        }
                    });
        }

        private void giveUp(Throwable why) {
            ended = true;
            running.cancel();
            drive.lost(why);
        }
    }
}
