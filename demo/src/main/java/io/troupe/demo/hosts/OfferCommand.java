package io.troupe.demo.hosts;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Clock;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.BrokerEvent;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.common.text.Suggestions;
import io.troupe.demo.table.ServiceJars;
import io.troupe.demo.terminal.Interruption;
import io.troupe.services.behaviour.WallFollower.CornerStyle;
import io.troupe.services.robot.RobotConnection;
import io.troupe.services.subsumption.RobotNode;
import io.troupe.services.subsumption.RobotServicesActor;
import io.troupe.services.subsumption.Service;
import io.troupe.services.subsumption.ServiceObserver;
import io.troupe.services.subsumption.SubsumptionTable;
import java.io.PrintWriter;
import java.lang.System.Logger.Level;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeoutException;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Help.Visibility;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe offer}: offers robot services on a bus, for an arbitrator on any host. */
@Command(
        name = "offer",
        description = "Offers services for the robots of a Player server on a bus over hosts, until Ctrl-C.",
        footer = {
            "  troupe offer --robots base:6665 --bus nats://base:4222",
            "  troupe offer --robots base:6665 --bus nats://base:4222 --services wallFollower --rank 1"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class OfferCommand implements Callable<Integer> {
    private static final Duration STOP_LIMIT = Duration.ofSeconds(5);

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--services",
            paramLabel = "NAME",
            split = ",",
            description = "services of the table, with commas; all of them unless given",
            showDefaultValue = Visibility.NEVER)
    private @Nullable List<String> services;

    @Option(
            names = "--robots",
            paramLabel = "HOST:PORT",
            required = true,
            description = "the Player server of the robots, for example a troupe serve")
    private String robots;

    @Mixin
    private BusOptions busOptions;

    @Option(
            names = "--rank",
            paramLabel = "N",
            description = "of several nodes that offer a service, the one with the least rank is chosen")
    private int rank;

    @Option(
            names = "--table",
            paramLabel = "FILE",
            description = "the table of services; the paper's unless given. It specifies how walls are followed",
            showDefaultValue = Visibility.NEVER)
    private @Nullable Path table;

    @Option(
            names = "--corners",
            paramLabel = "STYLE",
            description = "how the wall follower of the paper's table turns at a wall ahead: FORWARD or BACKWARD")
    private CornerStyle corners = CornerStyle.FORWARD;

    @Mixin
    private ServiceJars jars;

    @Override
    public Integer call() throws InterruptedException {
        try (var opened = jars;
                var interruption = Interruption.open()) {
            var catalogue = opened.catalogue(table);
            SubsumptionTable read =
                    table == null ? SubsumptionTable.ofThePaper(corners) : ServiceJars.read(spec, table, catalogue);
            List<String> offered = offered(read);
            RobotAddress address = RobotAddress.parse(spec, robots);
            busOptions.settings(); // rejects wrong options before anything is opened
            checkReachable(address, read);
            offer(address, read, offered, interruption);
            return Interruption.STATUS;
        }
    }

    private List<String> offered(SubsumptionTable read) {
        List<String> names = read.services().stream().map(Service::name).toList();
        List<String> given = services;
        if (given == null) {
            return names;
        }
        for (String name : given) {
            if (!names.contains(name)) {
                throw new ParameterException(
                        spec.commandLine(),
                        "--services has '" + name + "'" + Suggestions.expected("services of the table", name, names));
            }
        }
        return given;
    }

    /** @throws io.troupe.player.PlayerException with the reason */
    private static void checkReachable(RobotAddress address, SubsumptionTable table) {
        var laser = table.robotsWithLaser();
        var devices = IntStream.range(0, table.robots())
                .mapToObj(robot -> new RobotConnection.Devices(robot, true, laser.contains(robot + 1)))
                .toList();
        RobotConnection.open(address.host(), address.port(), RobotConnection.Delivery.PULL, devices)
                .close();
    }

    private void offer(RobotAddress address, SubsumptionTable read, List<String> offered, Interruption interruption)
            throws InterruptedException {
        var lines = new Lines(spec.commandLine().getOut());
        try (var space = ActorSpace.create(SpaceSettings.named("broker"));
                var driving = ActorSpace.create(SpaceSettings.named("robots"));
                var bus = busOptions.open(BusSettings.on(space).withObserver(lines.ofBus()));
                var node = RobotNode.open(bus, space, lines::onBroker, rank)) {
            var settings = RobotServicesActor.Settings.defaults()
                    .withHost(address.host())
                    .withPort(address.port())
                    .withTable(read)
                    .withObserver(lines);
            var offer = node.offer(driving, settings, offered);
            offer.published().get(STOP_LIMIT);
            lines.print(bus.node() + " offers " + String.join(", ", offered) + " for the robots at " + address
                    + "; Ctrl-C ends it");
            var ended = new CountDownLatch(1);
            interruption.onRequest(ended::countDown);
            ended.await();
            offer.withdraw().get(STOP_LIMIT);
        } catch (TimeoutException overdue) {
            System.getLogger(OfferCommand.class.getName())
                    .log(Level.WARNING, "the robots have not confirmed their stop within {0}", STOP_LIMIT);
        }
    }

    /** Prints what happens, each with the seconds since the start. */
    private static final class Lines implements ServiceObserver {
        private final PrintWriter terminal;
        private final long startNanos = Clock.system().nanos();

        Lines(PrintWriter terminal) {
            this.terminal = terminal;
        }

        void print(String line) {
            double seconds = (Clock.system().nanos() - startNanos) / 1e9;
            synchronized (terminal) {
                terminal.printf(Locale.ROOT, "%7.1f s  %s%n", seconds, line);
                terminal.flush();
            }
        }

        private void print(int robot, String what) {
            print("robot " + (robot + 1) + ": " + what);
        }

        @Override
        public void serviceStarted(int robot, Service service) {
            print(robot, service + " starts");
        }

        @Override
        public void cycleEnded(int robot, Service service) {}

        @Override
        public void serviceEnded(int robot, Service service) {
            print(robot, service + " has stopped");
        }

        @Override
        public void leaseLost(int robot, Service service) {
            print(robot, service + " stops: its arbitrator has not renewed the lease in time");
        }

        BusObserver ofBus() {
            var logging = BusObserver.logging();
            return new BusObserver() {
                @Override
                public void lost(Loss loss) {
                    logging.lost(loss);
                }

                @Override
                public void disconnected(String why) {
                    print("not connected to the bus: " + why);
                }

                @Override
                public void connected() {
                    print("connected to the bus again");
                }
            };
        }

        void onBroker(BrokerEvent event) {
            switch (event) {
                case BrokerEvent.StartFailed(var provider, Throwable why) ->
                    print(provider.provider() + " could not be started: " + why.getMessage());
                case BrokerEvent.Failed(var provider, Throwable why) ->
                    print(provider.provider() + " has failed: " + why.getMessage());
                default -> System.getLogger(OfferCommand.class.getName()).log(Level.DEBUG, "{0}", event);
            }
        }
    }
}
