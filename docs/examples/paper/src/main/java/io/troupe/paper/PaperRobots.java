package io.troupe.paper;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.sim.WorldSettings;
import io.troupe.sim.model.Scenario;
import io.troupe.sim.worldfile.ScenarioReader;
import java.net.InetSocketAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.regex.Pattern;
import org.jspecify.annotations.Nullable;

/**
 * Where the two robots of a program are, and for how long it drives them. This is no part of the paper's code.
 *
 * <p>The arguments of each program are {@code [HOST:PORT] [--seconds N]}. Without an address the paper's arena is
 * simulated in this JVM, where it offers both robots on port 6665 with ids 0 and 1. It runs in lock step with the
 * program, as fast as that answers, so every run is the same.
 *
 * @param seconds by the robots' clock
 * @param arena the simulated one, or null if the robots are those of a Player server
 */
record PaperRobots(
        String host, int port, double seconds, @Nullable Arena arena) {
    private static final double SECONDS = 300;
    private static final Pattern ADDRESS = Pattern.compile("(.+):(\\d{1,5})");
    private static final int FAILED = 1;
    private static final int USED_WRONGLY = 2;

    /**
     * Runs a program. Ends the JVM with status 1 if the Player server cannot be reached or is lost, and with status 2
     * if the arguments are wrong.
     *
     * @param clients how many clients of the program a simulated world waits for before its time begins
     */
    static void drive(String[] arguments, int clients, Consumer<PaperRobots> program) {
        try {
            var options = Options.of(arguments);
            if (options.address == null) {
                try (var arena = Arena.open(clients)) {
                    program.accept(new PaperRobots("localhost", 6665, options.seconds, arena));
                }
            } else {
                var address = options.address;
                program.accept(new PaperRobots(address.getHostString(), address.getPort(), options.seconds, null));
            }
        } catch (IllegalArgumentException wrong) {
            end(USED_WRONGLY, wrong);
        } catch (PlayerException lost) {
            end(FAILED, lost);
        }
    }

    private static void end(int status, RuntimeException reason) {
        System.err.println(reason.getMessage());
        System.exit(status);
    }

    /** @param address of a Player server; null if there is none, so that the arena is to be simulated */
    private record Options(@Nullable InetSocketAddress address, double seconds) {
        static Options of(String... arguments) {
            InetSocketAddress address = null;
            double seconds = SECONDS;
            for (int i = 0; i < arguments.length; i++) {
                var hostAndPort = ADDRESS.matcher(arguments[i]);
                if (arguments[i].equals("--seconds") && i + 1 < arguments.length) {
                    i++;
                    seconds = seconds(arguments[i]);
                } else if (hostAndPort.matches()) {
                    address = InetSocketAddress.createUnresolved(
                            hostAndPort.group(1), Integer.parseInt(hostAndPort.group(2)));
                } else {
                    throw new IllegalArgumentException(
                            "an argument is '" + arguments[i] + "', expected [HOST:PORT] [--seconds N]");
                }
            }
            return new Options(address, seconds);
        }

        private static double seconds(String text) {
            double seconds;
            try {
                seconds = Double.parseDouble(text);
            } catch (NumberFormatException noNumber) {
                seconds = Double.NaN;
            }
            if (seconds > 0 && Double.isFinite(seconds)) {
                return seconds;
            }
            throw new IllegalArgumentException("--seconds is '" + text + "', expected a number above 0");
        }
    }

    /** The paper's arena, whose time passes while a program drives its robots. */
    record Arena(Simulation simulation, SimulationRunner runner, CompletableFuture<@Nullable Void> standstill)
            implements AutoCloseable {
        static Arena open(int clients) {
            var simulation = Simulation.open(scenario(), WorldSettings.defaults());
            var standstill = new CompletableFuture<@Nullable Void>();
            var runner = SimulationRunner.start(simulation, clients, snapshot -> {
                if (simulation.isPaused()) {
                    standstill.complete(null);
                }
            });
            return new Arena(simulation, runner, standstill);
        }

        static Scenario scenario() {
            var here = Path.of("").toAbsolutePath();
            for (Path folder = here; folder != null; folder = folder.getParent()) {
                var world = folder.resolve("demo/worlds/paper-arena.cfg");
                if (Files.exists(world)) {
                    return ScenarioReader.read(world);
                }
            }
            throw new IllegalArgumentException("there is no demo/worlds/paper-arena.cfg in " + here + " or above it");
        }

        @Override
        public void close() {
            runner.close();
            simulation.close();
        }
    }

    /**
     * Runs actors on a space until the time is over. Then they are stopped, and with the services their robots.
     *
     * @param application starts the actors, and returns the main code before the services that it uses
     */
    void driveByActors(Function<ActorSpace, List<Actor>> application) {
        var settings = SpaceSettings.named("robots").withOnError((where, error) -> {
            if (!(error instanceof ActorStoppedException)) { // the last request is not answered when the time is over
                System.err.println(where + ": " + error);
            }
        });
        try (var space = ActorSpace.create(settings)) {
            var end = space.sequential(this::watchTime).toCompletableFuture();
            List<Actor> actors = application.apply(space);
            end.join();
            if (arena != null) {
                arena.standstill.join();
            }
            for (var each : actors) {
                var stopped = space.whenStopped(each).toCompletableFuture();
                space.stop(each);
                stopped.join();
            }
            var idle =
                    new CompletableFuture<@Nullable Void>(); // a reading on its way to a closed space is a dead letter
            space.onIdle(() -> idle.complete(null));
            idle.join();
        } catch (CompletionException failed) {
            throw failed.getCause() instanceof PlayerException lost ? lost : failed;
        }
    }

    /** Stops the time of a simulated world within the last reading, so that the program prints the same in each run. */
    private @Nullable Void watchTime() {
        var clock = new PlayerClient(host, port);
        try {
            clock.requestDataDeliveryMode(PlayerConstants.PLAYER_DATAMODE_PULL);
            var sonar = clock.requestInterfaceSonar(0, PlayerConstants.PLAYER_OPEN_MODE);
            clock.runThreaded(-1, -1);
            clock.nextData().await();
            double startSeconds = sonar.getTimestamp();
            while (sonar.getTimestamp() - startSeconds < seconds) {
                clock.nextData().await();
            }
            if (arena != null) {
                arena.simulation.pause();
            }
        } finally {
            clock.close();
        }
        return null;
    }
}
