package io.troupe.view.live;

import io.troupe.actor.CallGraph;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Clock;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.SubsumptionTable;
import io.troupe.sim.Contact;
import io.troupe.sim.RobotReading;
import io.troupe.sim.Simulation;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.WorldSpec;
import io.troupe.view.Json;
import io.troupe.view.RecordedHostedRun;
import io.troupe.view.RecordedRun;
import io.troupe.view.RobotRecord;
import io.troupe.view.RunRecorder;
import io.troupe.view.RunResult.StateChange;
import io.troupe.view.live.ViewCommand.Intervention;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.BooleanSupplier;
import java.util.function.IntFunction;
import org.jspecify.annotations.Nullable;

/**
 * Shows a run on a live page, in a file, or on both.
 *
 * <p><b>Role.</b> A {@link RecordedRun} gets its {@link #listener}; other loops call {@link #moved}.
 *
 * <p><b>Threads.</b> The thread that advances the world.
 *
 * <p><b>Order.</b> Whether a run is shown makes no difference to it: this reads immutable snapshots, and never waits
 * unless a viewer has paused or slowed down the run.
 */
public final class ViewedRun {
    private static final long SPEED_NANOS = 1_000_000_000;
    /** A robot that is farther away at the next tick than at twice its speed, and this, was put there. */
    private static final double JUMP_M = 0.3;

    private final WorldSpec world;
    private final List<String> services;
    private final @Nullable SubsumptionTable table;
    private final RunControl control;
    private final List<ViewSink> sinks = new ArrayList<>();
    private final boolean[] stalled;
    private final int[] jumps; // by robot
    private @Nullable Snapshot before;
    private @Nullable CallGraph callGraph;
    private final Map<Integer, Integer> driversShown = new HashMap<>(); // by robot
    private final Set<Integer> driven = new TreeSet<>();
    private List<ColouredBox> boxesShown = List.of();
    private long frames;
    private int statesShown;
    private double speed;
    private long speedNanos;
    private long speedMicros;

    /** Prepares to show a run of the services of a table. */
    public ViewedRun(WorldSpec world, SubsumptionTable table, RunControl control) {
        this(world, table.services().stream().map(Service::name).toList(), table, control);
    }

    /** Prepares to show a world in which nothing is known about services. */
    public ViewedRun(WorldSpec world, RunControl control) {
        this(world, List.of(), null, control);
    }

    private ViewedRun(WorldSpec world, List<String> services, @Nullable SubsumptionTable table, RunControl control) {
        this.world = world;
        this.services = services;
        this.table = table;
        this.control = control;
        this.stalled = new boolean[world.robots().size()];
        this.jumps = new int[world.robots().size()];
    }

    /** Shows it on a live page, too. */
    public ViewedRun onto(LiveView page) {
        return onto(page, control);
    }

    /** Shows it on a live page, too, whose commands another control carries out. */
    public ViewedRun onto(LiveView page, ViewControl other) {
        callGraph = page.callGraph();
        return add(page.show(other), other.offers());
    }

    /** Collects it for a file, too. */
    public ViewedRun onto(ViewFile file) {
        return add(file, List.of());
    }

    private ViewedRun add(ViewSink sink, List<String> offers) {
        sink.world(new ViewedWorld(world, services, offers));
        sinks.add(sink);
        return this;
    }

    /** Shows a recorded run, and lets viewers control it if it runs in this process. */
    public RecordedRun.Listener listener(RecordedRun.Listener inner) {
        return new RecordedRun.Listener.Forwarding(inner) {
            @Override
            public @Nullable CallObserver callObserver() {
                return withCallGraph(inner.callObserver());
            }

            @Override
            public void beforeTick(Simulation simulation, RunRecorder recorder) throws InterruptedException {
                inner.beforeTick(simulation, recorder);
                for (Intervention each : control.await(simulation.timeMicros(), inner::isStopRequested)) {
                    if (intervene(simulation, each)) {
                        recorder.intervened(each.words());
                    }
                }
            }

            @Override
            public void recorded(Snapshot snapshot, RunRecorder recorder) {
                inner.recorded(snapshot, recorder);
                show(snapshot, recorder);
            }
        };
    }

    private @Nullable CallObserver withCallGraph(@Nullable CallObserver other) {
        if (callGraph == null) {
            return other;
        }
        return other == null ? callGraph : callGraph.and(other);
    }

    /** Shows a run over hosts. */
    public RecordedHostedRun.Listener hostedListener(RecordedHostedRun.Listener inner) {
        return new RecordedHostedRun.Listener() {
            @Override
            public void stateStarted(String line) {
                inner.stateStarted(line);
            }

            @Override
            public void driverChanged(String line) {
                inner.driverChanged(line);
            }

            @Override
            public void ticked(long timeMicros) {
                inner.ticked(timeMicros);
            }

            @Override
            public boolean isStopRequested() {
                return inner.isStopRequested();
            }

            @Override
            public @Nullable CallObserver callObserver() {
                return withCallGraph(inner.callObserver());
            }

            @Override
            public void recorded(Snapshot snapshot, RunRecorder recorder) {
                inner.recorded(snapshot, recorder);
                show(snapshot, recorder);
            }
        };
    }

    private void show(Snapshot snapshot, RunRecorder recorder) {
        List<StateChange> changes = recorder.states();
        for (; statesShown < changes.size(); statesShown++) {
            showState(changes.get(statesShown));
        }
        List<RobotRecord> robots = recorder.robots();
        for (RobotRecord robot : robots) {
            showDrivers(robot);
        }
        moved(snapshot, robot -> robots.get(robot).serviceName());
    }

    private void showState(StateChange change) {
        var event =
                event(change.timeMicros(), "state").put("state", change.state().number());
        if (change.seenBy() != null) {
            event.put("robot", change.seenBy() + 1);
        }
        if (table != null) {
            event.put("text", change.cause(table))
                    .put("colourName", table.colourName(change.state().colour()));
        }
        send(event.put("colour", change.state().colour())
                .put("services", Json.texts(change.state().services())));
    }

    private void showDrivers(RobotRecord robot) {
        List<RobotRecord.Driver> drivers = robot.drivers();
        for (int i = driversShown.getOrDefault(robot.index(), 0); i < drivers.size(); i++) {
            String node = drivers.get(i).node();
            var event = event(drivers.get(i).fromMicros(), "driver").put("robot", robot.index() + 1);
            send(node == null ? event : event.put("node", node));
        }
        driversShown.put(robot.index(), drivers.size());
    }

    /**
     * Waits while viewers have paused the run or slowed it down, and changes the world as they want before the next
     * tick.
     */
    public void beforeTick(Simulation simulation, BooleanSupplier stop) throws InterruptedException {
        for (Intervention each : control.await(simulation.timeMicros(), stop)) {
            intervene(simulation, each);
        }
    }

    /** Waits like {@link #beforeTick}, in a run in which nothing can be changed. */
    public void awaitTurn(long timeMicros, BooleanSupplier stop) throws InterruptedException {
        control.await(timeMicros, stop);
    }

    /** Changes the world, if that is possible; viewers see that it was, or why not. */
    private boolean intervene(Simulation simulation, Intervention intervention) {
        long now = simulation.timeMicros();
        try {
            SimulationControl.carryOut(intervention, simulation);
        } catch (IllegalArgumentException refused) {
            send(event(now, "refused").put("text", String.valueOf(refused.getMessage())));
            return false;
        }
        intervened(now, intervention);
        return true;
    }

    /** Shows that a viewer has changed the world. */
    public void intervened(long timeMicros, Intervention intervention) {
        if (intervention instanceof ViewCommand.Drive drive) {
            driven.add(drive.robot());
        } else if (intervention instanceof ViewCommand.Release release) {
            driven.remove(release.robot());
        } else if (intervention instanceof ViewCommand.Place place) {
            jumps[place.robot()]++;
        } else if (intervention instanceof ViewCommand.Reset) {
            Arrays.setAll(jumps, robot -> jumps[robot] + 1);
        }
        send(event(timeMicros, "intervention").put("text", intervention.words()));
    }

    /**
     * Shows the world at a tick.
     *
     * @param serviceOf name of the service that drives a robot, by index
     */
    public void moved(Snapshot snapshot, IntFunction<String> serviceOf) {
        for (Contact contact : snapshot.contacts()) {
            var event = event(contact.timeMicros(), "contact").put("robot", contact.robot() + 1);
            send(
                    contact.otherRobot() >= 0
                            ? event.put("otherRobot", contact.otherRobot() + 1)
                            : event.put("obstacle", contact.other()));
        }
        noteJumps(snapshot);
        var states = new short[snapshot.robots().size()];
        for (int robot = 0; robot < states.length; robot++) {
            states[robot] = (short)
                    (number(serviceOf.apply(robot)) | flags(robot, snapshot) | jumps[robot] << ViewFrame.JUMPS_SHIFT);
        }
        for (Contact contact : snapshot.contacts()) {
            states[contact.robot()] |= ViewFrame.TOUCHED;
            if (contact.otherRobot() >= 0) {
                states[contact.otherRobot()] |= ViewFrame.TOUCHED;
            }
        }
        for (int robot : driven) {
            states[robot] |= ViewFrame.DRIVEN_BY_HAND;
        }
        for (int robot : snapshot.away()) {
            states[robot] |= ViewFrame.AWAY;
        }
        showBoxes(snapshot);
        measureSpeed(snapshot.timeMicros());
        var frame = new ViewFrame(frames++, snapshot, states, speed);
        sinks.forEach(sink -> sink.frame(frame));
    }

    /** Clients of a simulation put robots elsewhere without an intervention. */
    private void noteJumps(Snapshot snapshot) {
        Snapshot last = before;
        before = snapshot;
        if (last == null) {
            return;
        }
        double seconds = (snapshot.timeMicros() - last.timeMicros()) / 1e6;
        for (int robot = 0; robot < jumps.length; robot++) {
            RobotReading here = snapshot.robots().get(robot);
            RobotReading there = last.robots().get(robot);
            double wayM = StrictMath.hypot(
                    here.pose().x() - there.pose().x(),
                    here.pose().y() - there.pose().y());
            double speedMps = StrictMath.max(speedMps(here), speedMps(there));
            if (wayM > JUMP_M + 2 * speedMps * seconds) {
                jumps[robot]++;
            }
        }
    }

    private static double speedMps(RobotReading reading) {
        return StrictMath.hypot(
                reading.odometry().forwardMps(), reading.odometry().sidewaysMps());
    }

    private void showBoxes(Snapshot snapshot) {
        if (!snapshot.boxes().equals(boxesShown)) {
            boxesShown = snapshot.boxes();
            var boxes = Json.texts(boxesShown.stream().map(ColouredBox::words).toList());
            send(event(snapshot.timeMicros(), "boxes").put("boxes", boxes));
        }
    }

    /** Shows the world of robots without known services at a tick. */
    public void moved(Snapshot snapshot) {
        moved(snapshot, robot -> "none");
    }

    private int number(String service) {
        if (service.equals("none")) {
            return ViewFrame.NO_SERVICE;
        }
        int index = services.indexOf(service);
        return index < 0 || index >= ViewFrame.OTHER_SERVICE - 1
                ? ViewFrame.OTHER_SERVICE
                : ViewFrame.FIRST_SERVICE + index;
    }

    private int flags(int robot, Snapshot snapshot) {
        RobotReading reading = snapshot.robots().get(robot);
        boolean stalls = reading.odometry().stalled();
        if (stalls && !stalled[robot]) {
            send(event(snapshot.timeMicros(), "stall").put("robot", robot + 1));
        }
        stalled[robot] = stalls;
        return stalls ? ViewFrame.STALLED : 0;
    }

    private void measureSpeed(long timeMicros) {
        long now = Clock.system().nanos();
        long passed = now - speedNanos;
        if (frames == 0 || passed >= SPEED_NANOS) {
            speed = frames == 0 ? 0 : (timeMicros - speedMicros) * 1000.0 / passed;
            speedNanos = now;
            speedMicros = timeMicros;
        }
    }

    private static Json event(long timeMicros, String kind) {
        return new Json().put("t", timeMicros / 1e6).put("kind", kind);
    }

    private void send(Json event) {
        String json = event.toString();
        sinks.forEach(sink -> sink.event(json));
    }
}
