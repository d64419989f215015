package io.troupe.demo.serve;

import io.troupe.common.text.Plural;
import io.troupe.demo.terminal.FileProblems;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.Interruption.InterruptedCommand;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.RunFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.sim.RecordingException;
import io.troupe.sim.Replay;
import io.troupe.sim.Snapshot;
import io.troupe.sim.model.RobotSpec;
import io.troupe.sim.model.WorldSpec;
import io.troupe.tools.ProgressLine;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.ViewFile;
import io.troupe.view.live.ViewedRun;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.charset.CharacterCodingException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code troupe replay}: repeats a run recorded by {@code troupe serve --record}, bit for bit. */
@Command(
        name = "replay",
        description =
                "Replays what serve --record has written, checks that it is the same, and prints where the robots went.",
        footer = {
            "  troupe replay office.txt --world office.cfg",
            "  troupe replay office.txt --world office.cfg --view",
            "  troupe replay office.txt --world office.cfg --html office.html"
        },
        mixinStandardHelpOptions = true)
public final class ReplayCommand implements Callable<Integer> {
    private static final int TICKS_PER_REPORT = 50;

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "RECORDING", description = "the file that serve --record has written")
    private Path recording;

    @Mixin
    private WorldOptions worlds;

    @Mixin
    private ViewOptions view;

    @Option(
            names = "--html",
            paramLabel = "FILE",
            description = "write a page with the recording, which any browser plays")
    private @Nullable Path html;

    @Option(
            names = "--out",
            paramLabel = "DIR",
            description = "write trajectory.svg and run.jsonl of the recording there")
    private @Nullable Path out;

    @Override
    public Integer call() throws IOException {
        recording = FileProblems.input(spec, recording, "what serve --record has written");
        WorldSpec world = worlds.scenario().world();
        if (html != null) {
            FileProblems.checkOutput(spec, "--html", html);
        }
        Replay replay = read();
        var travelled = new Travelled(world.robots().size());
        PrintWriter terminal = spec.commandLine().getOut();
        ViewFile film = html == null ? null : new ViewFile();
        double seconds = replay.ticks() * world.intervalMillis() / 1000.0;
        try (var interruption = Interruption.open();
                var page = view.open();
                var files = out == null ? null : new RunFiles(spec, out, world, seconds)) {
            if (files != null) {
                files.open();
            }
            try {
                Consumer<Snapshot> viewer = viewer(world, page, film, interruption);
                Consumer<Snapshot> recorder = files == null ? viewer : viewer.andThen(files::record);
                long checksum = play(replay, world, recorder, travelled, interruption);
                terminal.printf(
                        Locale.ROOT,
                        "%s of world %s, the same bit for bit; checksum %08x%n",
                        Plural.of(replay.ticks(), "tick"),
                        world.name(),
                        checksum);
            } catch (InterruptedCommand interrupted) {
                terminal.println("interrupted: " + travelled.ticks + " of " + Plural.of(replay.ticks(), "tick")
                        + " of world " + world.name() + " were played");
            }
            if (film != null && html != null) {
                OutputFiles.write(html, film.html());
            }
            print(travelled, world.robots(), terminal);
            if (files != null) {
                terminal.println(files.finish(travelled.ticks < replay.ticks()));
                terminal.flush();
            }
            return interruption.isRequested() ? Interruption.STATUS : 0;
        }
    }

    /** Shows the recording at the pace that viewers want, if there are to be any. */
    private static Consumer<Snapshot> viewer(
            WorldSpec world, @Nullable LiveView page, @Nullable ViewFile film, Interruption interruption) {
        if (page == null && film == null) {
            return snapshot -> {};
        }
        var viewed = new ViewedRun(world, new RunControl(page == null ? 0 : 1, false));
        if (page != null) {
            viewed.onto(page);
        }
        if (film != null) {
            viewed.onto(film);
        }
        return snapshot -> {
            try {
                viewed.awaitTurn(snapshot.timeMicros(), interruption::isRequested);
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
                throw new IllegalStateException("interrupted while showing the recording", e);
            }
            viewed.moved(snapshot);
        };
    }

    private static long play(
            Replay replay, WorldSpec world, Consumer<Snapshot> viewer, Travelled travelled, Interruption interruption) {
        try (var line = ProgressLine.open()) {
            return replay.play(world, snapshot -> {
                interruption.check();
                travelled.add(snapshot);
                viewer.accept(snapshot);
                if (snapshot.tick() % TICKS_PER_REPORT == 0) {
                    line.show("", snapshot.tick() + " of " + replay.ticks() + " ticks");
                }
            });
        }
    }

    private static void print(Travelled travelled, List<RobotSpec> robots, PrintWriter terminal) {
        for (int i = 0; i < robots.size(); i++) {
            terminal.printf(
                    Locale.ROOT,
                    "%s: %.1f m, %s%n",
                    robots.get(i).name(),
                    travelled.distanceM[i],
                    Plural.of(travelled.contacts[i], "contact"));
        }
        terminal.flush();
    }

    private Replay read() throws IOException {
        try (var reader = Files.newBufferedReader(recording)) {
            return Replay.read(reader);
        } catch (CharacterCodingException e) {
            throw new ParameterException(spec.commandLine(), recording + " is not a recording: it is not text", e);
        } catch (RecordingException e) {
            throw new ParameterException(spec.commandLine(), recording + ": " + e.getMessage(), e);
        }
    }

    /** Distance and contacts of each robot. */
    private static final class Travelled {
        private final double[] distanceM;
        private final int[] contacts;
        private final double[] x;
        private final double[] y;
        private long ticks;

        Travelled(int robots) {
            distanceM = new double[robots];
            contacts = new int[robots];
            x = new double[robots];
            y = new double[robots];
        }

        void add(Snapshot snapshot) {
            ticks = snapshot.tick();
            for (int i = 0; i < x.length; i++) {
                var pose = snapshot.robots().get(i).pose();
                if (snapshot.tick() > 0) {
                    distanceM[i] += StrictMath.hypot(pose.x() - x[i], pose.y() - y[i]);
                }
                x[i] = pose.x();
                y[i] = pose.y();
            }
            for (var contact : snapshot.contacts()) {
                contacts[contact.robot()]++;
                if (contact.otherRobot() >= 0) {
                    contacts[contact.otherRobot()]++;
                }
            }
        }
    }
}
