package io.troupe.demo.app;

import io.troupe.broker.BrokerEvent;
import io.troupe.broker.ServiceRecord;
import io.troupe.bus.Address;
import io.troupe.bus.Loss;
import io.troupe.common.text.NamedColours;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.ComponentObserver;
import io.troupe.services.component.application.ApplicationEvent;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import io.troupe.services.component.kinds.RobotTopics.PositionReading;
import io.troupe.sim.Snapshot;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.LongSupplier;
import java.util.stream.Collectors;

/**
 * Reports events of an application as they happen, and a summary at its end.
 *
 * <p><b>Threads.</b> Any thread; guarded by one lock. Most calls come from the application's space, those about the
 * world from the thread that advances e.
 */
final class AppReport implements ComponentObserver {
    private final PrintWriter terminal;
    private final Map<String, Integer> loops = new TreeMap<>(); // by the topic with a robot's commands
    private LongSupplier clockMicros = () -> 0;
    private double[] distanceM = {};
    private int[] contacts = {};
    private Snapshot last;
    private final Map<String, Integer> losses = new TreeMap<>(); // by kind
    private final Map<String, Odometry> odometry = new TreeMap<>(); // by robot, if the world is elsewhere

    /** A robot's way by its own account. */
    private record Odometry(double distanceM, PositionReading last) {
        Odometry then(PositionReading now) {
            return new Odometry(distanceM + StrictMath.hypot(now.xM() - last.xM(), now.yM() - last.yM()), now);
        }
    }

    AppReport(PrintWriter terminal) {
        this.terminal = terminal;
    }

    /** Starts the recording of the world. */
    synchronized void watch(Snapshot first, LongSupplier newClockMicros) {
        last = first;
        clockMicros = newClockMicros;
        distanceM = new double[first.robots().size()];
        contacts = new int[first.robots().size()];
    }

    /** Starts the report of an application whose world is elsewhere. */
    synchronized void watch(LongSupplier newClockMicros) {
        clockMicros = newClockMicros;
    }

    /** A robot's position, from its topic. */
    synchronized void moved(String topic, PositionReading now) {
        odometry.compute(
                topic.substring(0, topic.indexOf('/')),
                (robot, before) -> before == null ? new Odometry(0, now) : before.then(now));
    }

    /** How far a robot has come by odometry. */
    synchronized double odometryM(String robot) {
        var known = odometry.get(robot);
        return known == null ? 0 : known.distanceM();
    }

    /** This node serves components. */
    synchronized void serves(String node, List<String> components, String application) {
        terminal.println(node + " serves " + String.join(", ", components) + " for " + application + ", until Ctrl-C");
        terminal.flush();
    }

    /** The bus has lost something; of each kind of loss, number 1, 2, 4, 8 and so on are printed. */
    void lost(Loss loss) {
        int soFar = count(loss);
        if (Integer.bitCount(soFar) == 1) {
            print("lost", loss + (soFar == 1 ? "" : " (" + soFar + " of this kind so far)"));
        }
    }

    private synchronized int count(Loss loss) {
        return losses.merge(loss.getClass().getSimpleName(), 1, Integer::sum);
    }

    void connection(String what, String why) {
        print(what, why);
    }

    void state(String what, Address component) {
        print(what, component.name());
    }

    synchronized void moved(Snapshot snapshot) {
        for (int robot = 0; robot < distanceM.length; robot++) {
            var from = last.robots().get(robot).pose();
            var to = snapshot.robots().get(robot).pose();
            distanceM[robot] += StrictMath.hypot(to.x() - from.x(), to.y() - from.y());
        }
        for (var contact : snapshot.contacts()) {
            contacts[contact.robot()]++;
            if (contact.otherRobot() >= 0) {
                contacts[contact.otherRobot()]++;
            }
        }
        last = snapshot;
    }

    private synchronized void print(String what, String of) {
        terminal.printf(Locale.ROOT, "%7.1f s  %-10s %s%n", clockMicros.getAsLong() / 1e6, what, of);
        terminal.flush();
    }

    void onBroker(BrokerEvent event) {
        switch (event) {
            case BrokerEvent.Registered e -> print("offered", words(e.provider()));
            case BrokerEvent.Started e -> print("started", words(e.provider()));
            case BrokerEvent.Stopped e -> print("stopped", words(e.provider()));
            case BrokerEvent.StartFailed e ->
                print("not started", words(e.provider()) + ": " + e.why().getMessage());
            case BrokerEvent.Failed e ->
                print("failed", words(e.provider()) + ": " + e.why().getMessage());
            case BrokerEvent.Suspect e ->
                print("suspect", words(e.provider()) + ": " + e.why().getMessage());
            case BrokerEvent.StopFailed e ->
                print("not stopped", words(e.provider()) + ": " + e.why().getMessage());
            case BrokerEvent.UserFailed e ->
                print("trouble", e.need().by() + ": " + e.why().getMessage());
            default -> {
                // reported as an application event, or of no interest to users
            }
        }
    }

    private static String words(ServiceRecord provider) {
        String capabilities = String.join(", ", provider.capabilities());
        return provider.provider().name() + " (service " + provider.service()
                + (capabilities.isEmpty() ? ")" : "; " + capabilities + ")");
    }

    void onApplication(ApplicationEvent event) {
        switch (event) {
            case ApplicationEvent.Connected e ->
                print(
                        "connected",
                        e.need().by() + " with " + e.provider().provider().name() + words(e.wires()));
            case ApplicationEvent.Lost it -> print("lost", it.why().getMessage());
            case ApplicationEvent.Forwarded it -> forwarded(it);
            case ApplicationEvent.Replaced it ->
                print("replaced", it.what().old() + " by " + it.what().by());
            case ApplicationEvent.NotReplaced it ->
                print("not replaced", it.why().getMessage());
        }
    }

    private static String words(List<Wire<?>> wires) {
        return wires.isEmpty() ? "" : wires.stream().map(Wire::toString).collect(Collectors.joining(", ", ": ", ""));
    }

    private synchronized void forwarded(ApplicationEvent.Forwarded it) {
        if (it.wire().to().name().endsWith("/velocity")) {
            loops.merge(it.wire().to().name(), 1, Integer::sum);
        }
    }

    // ---- component events

    @Override
    public void dropped(Address component, ApplicationData<?> lost, long total) {
        print("lost", component.name() + ": " + lost + " (" + total + " so far)");
    }

    @Override
    public void problem(Address component, String what, Throwable why) {
        print("problem", component.name() + " " + what + ": " + why.getMessage());
    }

    @Override
    public void info(Address component, String what) {
        print("told", component.name() + ": " + what);
    }

    /** Called for each {@code ColourSeen} that a component publishes. */
    void saw(String component, ColourSeen seen) {
        print("seen", component + " sees " + NamedColours.name(seen.colour()));
    }

    // ---- the summary

    synchronized void summary(String application, String world) {
        terminal.printf(Locale.ROOT, "%n%s on %s, %.1f s simulated%n", application, world, last.timeMicros() / 1e6);
        for (int robot = 0; robot < distanceM.length; robot++) {
            int commands = loops.getOrDefault("robot" + (robot + 1) + "/velocity", 0);
            terminal.printf(
                    Locale.ROOT,
                    "robot %d  %7.2f m  %6s loops over the bus  %d contacts%n",
                    robot + 1,
                    distanceM[robot],
                    commands == 0 ? "no" : commands,
                    contacts[robot]);
        }
        terminal.flush();
    }

    /** Which files were written. */
    synchronized void wrote(String words) {
        terminal.println(words);
        terminal.flush();
    }

    /** The summary of an application whose world is elsewhere. */
    synchronized void summary(String application) {
        terminal.printf(Locale.ROOT, "%n%s over a bus, %.1f s%n", application, clockMicros.getAsLong() / 1e6);
        odometry.forEach((robot, way) -> {
            int commands = loops.getOrDefault(robot + "/velocity", 0);
            terminal.printf(
                    Locale.ROOT,
                    "%-8s %7.2f m by odometry  %6s loops over the bus%n",
                    robot,
                    way.distanceM(),
                    commands == 0 ? "no" : commands);
        });
        terminal.flush();
    }
}
