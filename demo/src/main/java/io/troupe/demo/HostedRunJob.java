package io.troupe.demo;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.broker.BrokerEvent;
import io.troupe.bus.BusMessage;
import io.troupe.bus.BusMessage.Purpose;
import io.troupe.bus.BusObserver;
import io.troupe.bus.BusSettings;
import io.troupe.bus.Loss;
import io.troupe.demo.hosts.BusOptions;
import io.troupe.demo.terminal.Interruption;
import io.troupe.demo.terminal.OutputFiles;
import io.troupe.demo.terminal.ViewOptions;
import io.troupe.services.subsumption.RobotNode;
import io.troupe.view.Pictures;
import io.troupe.view.RecordedHostedRun;
import io.troupe.view.RunLog;
import io.troupe.view.RunResult;
import io.troupe.view.live.LiveView;
import io.troupe.view.live.RunControl;
import io.troupe.view.live.ViewControl;
import io.troupe.view.live.ViewedRun;
import java.io.IOException;
import java.io.PrintWriter;
import java.lang.System.Logger.Level;
import java.nio.file.Path;
import java.util.Locale;
import java.util.concurrent.atomic.LongAdder;
import org.jspecify.annotations.Nullable;
import picocli.CommandLine.Model.CommandSpec;

/** The part of {@code troupe run} that is over hosts: the arbitrator and the record. */
final class HostedRunJob {
    /** Of two arbitrators for one application, the bus refuses the second. */
    static final String NODE = "arbitrator";

    private final BusOptions busOptions;
    private final ViewOptions viewOptions;
    private final Path out;
    private final PrintWriter terminal;
    private final LongAdder losses = new LongAdder();

    HostedRunJob(CommandSpec spec, BusOptions busOptions, ViewOptions viewOptions, Path out) {
        this.viewOptions = viewOptions;
        this.busOptions = busOptions;
        this.out = out;
        this.terminal = spec.commandLine().getOut();
    }

    void run(RecordedHostedRun.Settings settings, Interruption interruption) throws IOException, InterruptedException {
        Path file = out.resolve("run.jsonl");
        RunResult result = record(settings, file, interruption);
        report(settings, result, file, interruption);
    }

    private RunResult record(RecordedHostedRun.Settings settings, Path file, Interruption interruption)
            throws IOException, InterruptedException {
        try (var page = viewOptions.open();
                var progress = ProgressBar.onTerminal(settings.seconds());
                var space = ActorSpace.create(settings(page));
                var bus = busOptions.open(NODE, BusSettings.on(space).withObserver(observer(progress, page)));
                var node = RobotNode.open(bus, space, HostedRunJob::log, 0);
                var log = new RunLog(file)) {
            var run = new RecordedHostedRun(settings);
            interruption.onRequest(run::stop);
            var listener = progress.hostedListener(line -> print(progress, line), interruption);
            return run.run(node, log, viewed(page, settings, listener));
        }
    }

    /** The space of the arbitrator, whose calls the page shows, if there is one. */
    static SpaceSettings settings(@Nullable LiveView page) {
        var settings = SpaceSettings.named("broker");
        return page == null ? settings : settings.withCallObserver(page.callGraph());
    }

    /** The listener of a run that is also shown on a page, if there is one; viewers can only look at it. */
    static RecordedHostedRun.Listener viewed(
            @Nullable LiveView page, RecordedHostedRun.Settings settings, RecordedHostedRun.Listener listener) {
        return page == null
                ? listener
                : new ViewedRun(settings.world(), settings.table(), new RunControl(0, false))
                        .onto(page, ViewControl.NONE)
                        .hostedListener(listener);
    }

    private void report(RecordedHostedRun.Settings settings, RunResult result, Path file, Interruption interruption)
            throws IOException {
        terminal.printf(
                Locale.ROOT,
                "%n%s, %s mode, robots at %s:%d: %s s%n",
                settings.world().name(),
                settings.mode(),
                settings.host(),
                settings.port(),
                result.duration());
        terminal.print(result.summary());
        terminal.println("messages that the bus has lost: " + losses);
        terminal.flush(); // before writing files, which may fail
        if (interruption.isRequested()) {
            terminal.println("interrupted: this is what was done until then; the last line of run.jsonl has that");
        }
        if (result.robots().getFirst().path().isEmpty()) {
            terminal.println("wrote " + file);
        } else {
            Path picture = out.resolve("trajectory.svg");
            OutputFiles.write(picture, Pictures.trajectory(settings.world(), result));
            terminal.println("wrote " + picture + " and " + file);
        }
        terminal.flush();
    }

    private void print(ProgressBar progress, String line) {
        progress.interrupt(() -> {
            terminal.println(line);
            terminal.flush();
        });
    }

    /** Counts a message of the arbitrator's node for the page, if there is one. */
    static void count(BusMessage message, @Nullable LiveView page) {
        if (page != null) {
            String from = message.from().node();
            String to = switch (message.purpose()) {
                case Purpose.Publication publication -> from.equals(NODE) ? "the other nodes" : NODE;
                case Purpose.Request request -> request.to().node();
                case Purpose.Notice notice -> notice.to().node();
                case Purpose.Reply reply -> reply.to().node();
                case Purpose.Rejection rejection -> rejection.to().node();
            };
            page.callGraph().note("bus", from, to);
        }
    }

    private BusObserver observer(ProgressBar progress, @Nullable LiveView page) {
        return new BusObserver() {
            @Override
            public void passed(BusMessage message) {
                count(message, page);
            }

            @Override
            public void lost(Loss loss) {
                losses.increment();
                System.getLogger(HostedRunJob.class.getName()).log(Level.DEBUG, "{0}", loss);
            }

            @Override
            public void disconnected(String why) {
                print(progress, "not connected to the bus: " + why);
            }

            @Override
            public void connected() {
                print(progress, "connected to the bus again");
            }
        };
    }

    private static void log(BrokerEvent event) {
        System.getLogger(HostedRunJob.class.getName()).log(Level.DEBUG, "{0}", event);
    }
}
