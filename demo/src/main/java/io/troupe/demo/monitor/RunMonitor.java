package io.troupe.demo.monitor;

import io.troupe.actor.CallObserver;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import io.troupe.petri.wiring.WiringMonitor;
import io.troupe.petri.wiring.WiringObserver;
import io.troupe.petri.wiring.WiringObserver.Followed;
import io.troupe.services.behaviour.Velocity;
import io.troupe.services.subsumption.Arbitrator;
import io.troupe.services.subsumption.Mode;
import io.troupe.services.subsumption.RobotServices;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.State;
import io.troupe.sim.Simulation;
import io.troupe.view.RecordedRun;
import io.troupe.view.RunRecorder;
import java.util.HashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;

/**
 * Follows a run of the main job through its {@link RunWiring declaration}: translates what the observers of actors,
 * services and states notice to the calls of the declaration.
 *
 * <table>
 * <caption>What is observed, and what it is in the declaration</caption>
 * <tr><td>a call of {@code drive}, {@code report} or {@code stop}</td><td>the arbitrator's call of a starter or
 *     stopper, which then asks the service</td></tr>
 * <tr><td>the services begin {@code drive} or {@code report}</td><td>{@code service.begin}</td></tr>
 * <tr><td>the promise of {@code stop} is settled</td><td>the answer of {@code service.stop}</td></tr>
 * <tr><td>a service ends that nothing has stopped, or a call of it is settled with an error</td><td>its
 *     failure</td></tr>
 * <tr><td>the arbitrator is sent {@code live} again</td><td>{@code stopper.done} of each robot</td></tr>
 * <tr><td>a service sends a colour, the arbitrator receives one</td><td>{@code promise.fulfil},
 *     {@code inbox.colour}</td></tr>
 * <tr><td>the next tick</td><td>{@code answered} of the services, {@code idle} of promises, inbox and
 * arbitrator, {@code data} of the services</td></tr>
 * </table>
 *
 * <p><b>Threads.</b> Any thread; one lock guards it.
 *
 * <p><b>Errors.</b> A violation ends the run at the next tick, by {@link WiringMonitor#check}.
 */
public final class RunMonitor {
    private final Mode mode;
    private final int robots;
    private final WiringMonitor monitor;
    private final List<String> answered; // the calls of the world, by robot
    private final List<String> idle;
    private final List<String> data;
    private final Set<Integer> sent = new HashSet<>(); // robots; in this tick
    private final Set<Integer> received = new HashSet<>();
    private final Set<Integer> stopping = new HashSet<>();
    private final Set<Integer> failed = new HashSet<>();
    private @Nullable Integer inCycle; // in sync mode
    private boolean isAlive;
    private boolean isSwitching;
    private int stopped; // robots that the arbitrator has stopped in this switch
    private boolean isOver; // after a failure

    public RunMonitor(Mode mode, int robots) {
        this(mode, robots, WiringMonitor.of(RunWiring.withFailures(mode, robots)));
    }

    /** @param monitor of the wiring for this mode and number of robots */
    RunMonitor(Mode mode, int robots, WiringMonitor monitor) {
        this.mode = mode;
        this.robots = robots;
        this.monitor = monitor;
        answered = calls("service", "answered");
        idle = calls("promise", "idle");
        data = calls("service", "data");
    }

    private List<String> calls(String component, String call) {
        return IntStream.rangeClosed(1, robots)
                .mapToObj(robot -> component + robot + "." + call)
                .toList();
    }

    /** One line that reports a run in which all was allowed. */
    public String summary() {
        return "monitor: " + monitor.count() + " events, all as declared for " + robots + " robots in " + mode
                + " mode";
    }

    /** The listener of a run that is followed. */
    public RecordedRun.Listener listener(RecordedRun.Listener inner) {
        return new RecordedRun.Listener.Forwarding(inner) {
            @Override
            public void beforeTick(Simulation simulation, RunRecorder recorder) throws InterruptedException {
                super.beforeTick(simulation, recorder);
                tick();
            }

            @Override
            public @Nullable CallObserver callObserver() {
                CallObserver other = super.callObserver();
                return other == null ? calls() : calls().and(other);
            }

            @Override
            public ServiceObserver services(ServiceObserver recorder) {
                return RunMonitor.this.services(super.services(recorder));
            }

            @Override
            public Arbitrator.StateListener states(Arbitrator.StateListener recorder) {
                return RunMonitor.this.states(super.states(recorder));
            }

            @Override
            public void closing() {
                super.closing();
                close();
            }

            @Override
            public void failed() {
                monitor.end();
                super.failed();
            }
        };
    }

    /** The world is about to tick: all have answered. */
    void tick() {
        if (mode != Mode.SYNC) {
            reading();
        }
        monitor.check();
    }

    private synchronized void reading() {
        sent.clear();
        received.clear();
        serviceCalls(answered);
        if (!isOver) {
            idle.forEach(call -> monitor.called("world", call));
            monitor.called("world", "inbox.idle");
            monitor.called("world", "arbitrator.idle");
        }
        serviceCalls(data);
    }

    private void serviceCalls(List<String> calls) {
        for (int robot = 0; robot < robots && !isOver; robot++) {
            if (failed.contains(robot)) {
                isOver = true;
                monitor.asked("world", calls.get(robot));
                monitor.on(Kind.REJECTED, "world", calls.get(robot));
            } else {
                monitor.called("world", calls.get(robot));
            }
        }
    }

    /** The run is going to be closed, which is not part of the declaration. */
    void close() {
        monitor.idle();
        monitor.end();
        monitor.check();
    }

    /** Observes the calls of the arbitrator and the services. */
    CallObserver calls() {
        return new CallObserver() {
            @Override
            public void called(Party from, Party to, Call call) {
                if (call.type() == Arbitrator.class && call.method().equals("live")) {
                    alive();
                }
            }

            @Override
            public void begun(Party actor, Call call) {
                if (isOfServices(call) && isStop(call)) {
                    stopping(robot(call));
                }
            }
        }.and(new WiringObserver(
                monitor, (from, to, call) -> isOfServices(call) ? Optional.of(of(call)) : Optional.empty()));
    }

    private static boolean isOfServices(CallObserver.Call call) {
        return call.type() == RobotServices.class && !call.isPassedOn();
    }

    /** A stop is answered when it is done, a start when it begins. */
    private Followed of(CallObserver.Call call) {
        int robot = robot(call);
        if (isStop(call)) {
            stopCalled(robot);
            return new Followed(
                    name("stopper", robot), name("service", robot) + ".stop", false, error -> failed(robot));
        }
        startCalled(robot);
        return new Followed(name("starter", robot), name("service", robot) + ".begin", true, error -> failed(robot));
    }

    private static int robot(CallObserver.Call call) {
        return (Integer) call.arguments().get(1); // after the lease
    }

    private static String name(String component, int robot) {
        return component + (robot + 1);
    }

    private static boolean isStop(CallObserver.Call call) {
        return call.method().equals("stop");
    }

    private synchronized void stopCalled(int robot) {
        stopsEnded(robot);
        stopped = robot + 1;
        monitor.called("arbitrator", name("stopper", robot) + ".send");
    }

    private synchronized void startCalled(int robot) {
        stopping.remove(robot);
        monitor.called("arbitrator", name("starter", robot) + ".send");
    }

    private synchronized void stopping(int robot) {
        stopping.add(robot);
    }

    /** The arbitrator stops all services, in the order of robots; one that has ended by itself needs no message. */
    private void stopsEnded(int upTo) {
        if (!isSwitching) {
            isSwitching = true;
            monitor.called("inbox", "arbitrator.change");
        }
        for (int robot = stopped; robot < upTo; robot++) {
            monitor.called("arbitrator", name("stopper", robot) + ".send");
            monitor.called(name("stopper", robot), name("service", robot) + ".stop");
        }
    }

    /** A service has failed; several signs of that are one event. */
    private synchronized void failed(int robot) {
        if (failed.add(robot)) {
            monitor.on(Kind.FAILED, "service" + (robot + 1), "");
        }
    }

    /** Without a stop, a service ends by its own colour in promise mode only; else it has failed. */
    private synchronized void ended(int robot) {
        if (!stopping.contains(robot) && !(mode == Mode.PROMISE && sent.contains(robot))) {
            failed(robot);
        }
    }

    private synchronized void alive() {
        if (isAlive) {
            stopsEnded(robots);
            for (int robot = 0; robot < robots; robot++) {
                monitor.called("arbitrator", name("stopper", robot) + ".done");
            }
        }
        isAlive = true;
        isSwitching = false;
        stopped = 0;
    }

    /** Whether this is the first message of a reading in callback mode, or any in promise mode. */
    private synchronized boolean isFirst(Set<Integer> seen, int robot) {
        return seen.add(robot) || mode == Mode.PROMISE;
    }

    private void ofServiceEnd(int robot) {
        if (mode != Mode.SYNC) {
            ended(robot);
            return;
        }
        if (inCycle != null) {
            failed(inCycle);
            inCycle = null;
        }
        monitor.called("loop", "service" + (robot + 1) + ".end");
    }

    /** Observes services, and passes everything on. */
    ServiceObserver services(ServiceObserver inner) {
        return new ServiceObserver() {
            @Override
            public void serviceStarted(int robot, Service service) {
                if (mode == Mode.SYNC) {
                    monitor.called("loop", "service" + (robot + 1) + ".start");
                }
                inner.serviceStarted(robot, service);
            }

            @Override
            public void cycleStarted(int robot, Service service) {
                if (mode == Mode.SYNC) {
                    inCycle = robot;
                    monitor.asked("loop", "service" + (robot + 1) + ".cycle");
                    monitor.taken("loop", "service" + (robot + 1) + ".cycle");
                }
                inner.cycleStarted(robot, service);
            }

            @Override
            public void commanded(int robot, Service service, Velocity velocity) {
                inner.commanded(robot, service, velocity);
            }

            @Override
            public void cycleEnded(int robot, Service service) {
                if (mode == Mode.SYNC) {
                    inCycle = null;
                    monitor.answered("loop", "service" + (robot + 1) + ".cycle");
                }
                inner.cycleEnded(robot, service);
            }

            @Override
            public void serviceEnded(int robot, Service service) {
                ofServiceEnd(robot);
                inner.serviceEnded(robot, service);
            }

            @Override
            public void colourSent(int robot, int colour) {
                if (isFirst(sent, robot)) {
                    monitor.called("service" + (robot + 1), "promise" + (robot + 1) + ".fulfil");
                }
                inner.colourSent(robot, colour);
            }

            @Override
            public void leaseLost(int robot, Service service) {
                inner.leaseLost(robot, service);
            }
        };
    }

    /** Listens to states, and passes everything on. */
    Arbitrator.StateListener states(Arbitrator.StateListener inner) {
        return new Arbitrator.StateListener() {
            @Override
            public void stateStarted(State state, @Nullable Integer seenBy) {
                inner.stateStarted(state, seenBy);
            }

            @Override
            public void colourReceived(int robot, int colour) {
                if (isFirst(received, robot)) {
                    monitor.called("promise" + (robot + 1), "inbox.colour");
                }
                inner.colourReceived(robot, colour);
            }

            @Override
            public void colourTooLate(int robot, int colour) {
                inner.colourTooLate(robot, colour);
            }
        };
    }
}
