package io.troupe.demo.serve;

import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.sim.Pace;
import io.troupe.sim.WorldSettings;
import io.troupe.tools.ProgressLine;
import java.io.IOException;
import java.io.PrintWriter;
import java.net.InetAddress;
import java.net.UnknownHostException;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.ArgGroup;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code troupe serve}: simulates a world and offers its robots to Player clients over TCP until interrupted. */
@Command(
        name = "serve",
        description = "Simulates a world and offers its robots to Player clients over TCP, until Ctrl-C.",
        footer = {
            "  troupe serve --view",
            "  troupe serve --world office.cfg --speed 10 --record office.txt",
            "  troupe serve --crowd 50 --lock-step --clients 50"
        },
        mixinStandardHelpOptions = true,
        showDefaultValues = true)
public final class ServeCommand implements Callable<Integer> {
    static final int PLAYER_PORT = 6665;

    private static final long CLOSING_SECONDS = 10;

    @Spec
    private CommandSpec spec;

    @Mixin
    private WorldOptions worlds;

    @Option(
            names = "--port",
            paramLabel = "PORT",
            description = "the port of devices for which the file names none; 0 = any that is free")
    private int port = PLAYER_PORT;

    @Option(
            names = "--bind",
            paramLabel = "ADDRESS",
            description =
                    "the address to listen on; the protocol knows no authentication, so think before you choose another")
    private String bind = "127.0.0.1";

    @ArgGroup
    private @Nullable Speed speed;

    /** The mutually exclusive speed options. */
    static final class Speed {
        @Option(names = "--realtime", description = "simulated time passes like ours (the default)")
        private boolean realtime;

        @Option(names = "--speed", paramLabel = "N", description = "N times as fast")
        private double factor = 1;

        @Option(
                names = "--lock-step",
                description =
                        "as fast as the clients answer: every tick waits for them; only clients in pull mode can answer, with others time passes like ours")
        private boolean lockStep;
    }

    @Option(
            names = "--clients",
            paramLabel = "N",
            description = "time begins when so many clients have subscribed and wait for data")
    private int clients = 1;

    @Option(
            names = "--max-clients",
            paramLabel = "N",
            description =
                    "how many clients may be connected at a time, on each port; more are disconnected at once. 0 = half of what the limit on open files leaves, at most 1000")
    private int maxClients;

    @Option(names = "--seconds", paramLabel = "N", description = "end after so much simulated time; 0 = never")
    private double seconds;

    @Option(names = "--seed", paramLabel = "N", description = "of everything random in the world")
    private long seed = 1;

    @Option(
            names = "--acceleration-bounds",
            description = "robots obey the acceleration_bounds of the world file; Stage does not")
    private boolean accelerationBounds;

    @Mixin
    private ViewOptions view;

    @Option(names = "--record", paramLabel = "FILE", description = "write down what happens, for an exact replay")
    private @Nullable Path record;

    @Override
    public Integer call() throws IOException, InterruptedException {
        Pace pace = pace();
        long endMicros = endMicros();
        if (clients < 1) {
            throw new ParameterException(
                    spec.commandLine(), "--clients is " + clients + ", expected a number of at least 1");
        }
        if (maxClients < 0) {
            throw new ParameterException(
                    spec.commandLine(), "--max-clients is " + maxClients + ", expected a number of at least 0");
        }
        InetAddress address = address();
        Path recording = record;
        if (recording != null) {
            FileProblems.checkOutput(spec, "--record", recording);
        }
        var serving = Serving.open(
                worlds.scenario(),
                WorldSettings.defaults().withSeed(seed).withAccelerationBounds(accelerationBounds),
                address,
                port,
                lockStep(),
                maxClients);
        var ended = new CountDownLatch(1);
        var hook = new Thread(() -> finish(serving, ended), "finish");
        Runtime.getRuntime().addShutdownHook(hook);
        PrintWriter terminal = spec.commandLine().getOut();
        try {
            try (serving;
                    var page = view.open();
                    var line = ProgressLine.open()) {
                if (recording != null) {
                    serving.record(recording);
                }
                terminal.println(serving.greeting());
                terminal.flush();
                serving.run(pace, clients, endMicros, line, page);
            }
            terminal.println(serving.farewell());
            terminal.flush();
        } finally {
            ended.countDown(); // lets the shutdown hook return; after that the virtual machine may exit at any time
            forget(hook);
        }
        return 0;
    }

    private InetAddress address() {
        if (port < 0 || port > 65_535) {
            throw new ParameterException(
                    spec.commandLine(), "--port is " + port + ", expected a number from 0 to 65535");
        }
        try {
            return InetAddress.getByName(bind);
        } catch (UnknownHostException e) {
            throw new ParameterException(
                    spec.commandLine(), "--bind is " + bind + ", expected an address of this machine");
        }
    }

    private boolean lockStep() {
        return speed != null && speed.lockStep;
    }

    private Pace pace() {
        if (lockStep()) {
            return new Pace.OfAnswers();
        }
        double factor = speed == null ? 1 : speed.factor;
        if (!(factor > 0 && factor <= 1e6)) {
            throw new ParameterException(
                    spec.commandLine(), "--speed is " + factor + ", expected a number above 0 and up to 1000000");
        }
        return new Pace.RealTime(factor);
    }

    private long endMicros() {
        if (!(seconds >= 0 && seconds <= 1e9)) {
            throw new ParameterException(
                    spec.commandLine(), "--seconds is " + seconds + ", expected a number from 0 to 1000000000");
        }
        return seconds == 0 ? Long.MAX_VALUE : StrictMath.round(seconds * 1e6);
    }

    private static void forget(Thread hook) {
        try {
            Runtime.getRuntime().removeShutdownHook(hook);
        } catch (IllegalStateException shuttingDown) {
            // the hook is already running
        }
    }

    /**
     * Body of the shutdown hook. It returns after clients are disconnected and the recording is written; then the
     * virtual machine exits.
     */
    private static void finish(Serving serving, CountDownLatch ended) {
        serving.stop();
        try {
            ended.await(CLOSING_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
