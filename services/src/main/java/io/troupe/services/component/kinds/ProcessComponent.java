package io.troupe.services.component.kinds;

import io.troupe.bus.BusTopic;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.Conversion;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

/**
 * Makes a component of an operating system process: a program in any language that connects to the robots by itself,
 * for example by the Player protocol.
 *
 * <p><b>Role.</b> Control signals: the process is started by its command line, counts as running from the first line on
 * its standard output, and is ended together with all processes that it has started. Data signals are lines of text. A
 * component named {@code c} subscribes to {@code c/in} and writes the lines to the process's standard input. It
 * publishes each line of the standard output on {@code c/out}, cut after 65,536 characters.
 *
 * <p><b>Processes.</b> On Linux, if the command {@code setsid} exists, the program leads a session without a terminal.
 * All processes of the session are ended when the component is terminated, when the program ends by itself, and when
 * this virtual machine shuts down. In a shutdown, an application first has 2 s to stop its components in its order. A
 * virtual machine that is killed ({@code kill -9}, {@code Runtime.halt}, a crash) ends no process: a program that must
 * not continue alone has to end at the end of its standard input, or when its connection to the server is closed. A
 * process that opens a new session, such as a daemon, is not ended if its parent has ended. Without {@code setsid},
 * this holds for every process whose parent has ended.
 *
 * <p><b>Errors.</b> The component fails if the process ends by itself. The failure is reported after the processes that
 * it started have ended, too; the error has the exit status and the last lines of the standard error. A termination is
 * rejected with the remaining processes if some are alive 10 s after they were killed. A robot that the program moved
 * over its connection has to be stopped by the server: Troupe's server does so when no client has the robot open.
 *
 * <p><b>Source.</b> Paper, section 2.1.1: packages may be built in different programming languages.
 */
public final class ProcessComponent {
    /** A line of text without its line terminator. */
    public record TextLine(String text) {}

    /** The program and its time limits, which are measured by the system clock. */
    public static final class Settings extends io.troupe.actor.Settings<Settings> {
        private final List<String> command;
        private final Path directory;
        private Duration startLimit = Duration.ofSeconds(10);
        private Duration stopLimit = Duration.ofSeconds(2);

        private Settings(List<String> command, Path directory) {
            this.command = List.copyOf(command);
            this.directory = directory;
        }

        /**
         * Settings with 10 s to start and 2 s to stop.
         *
         * @param command the program and its arguments
         * @param directory the working directory
         */
        public static Settings of(List<String> command, Path directory) {
            var settings = new Settings(command, directory);
            settings.check();
            return settings;
        }

        @Override
        protected void check() {
            if (command.isEmpty()) {
                throw new IllegalArgumentException("the command of a process is empty, expected a program");
            }
        }

        /** The time limit for the first line of output. */
        public Settings withStartLimit(Duration limit) {
            return with(copy -> copy.startLimit = limit);
        }

        /** The time that the processes have to end on request before they are killed. */
        public Settings withStopLimit(Duration limit) {
            return with(copy -> copy.stopLimit = limit);
        }

        public List<String> command() {
            return command;
        }

        public Path directory() {
            return directory;
        }

        public Duration startLimit() {
            return startLimit;
        }

        public Duration stopLimit() {
            return stopLimit;
        }
    }

    private ProcessComponent() {}

    public static Component<?, ?> of(String name, String service, Settings settings) {
        return new Component<>(
                service,
                List.of("process"),
                List.of(input(name)),
                List.of(output(name)),
                () -> new ExternalProcess(settings),
                new LinesConversion(name),
                Buffering.STREAM,
                Buffering.STREAM);
    }

    static BusTopic<TextLine> input(String name) {
        return new BusTopic<>(name + "/in", TextLine.class);
    }

    static BusTopic<TextLine> output(String name) {
        return new BusTopic<>(name + "/out", TextLine.class);
    }

    private record LinesConversion(String name) implements Conversion<String, String> {
        @Override
        public List<ApplicationData<?>> toApplication(String line) {
            return List.of(new ApplicationData<>(output(name), new TextLine(line)));
        }

        @Override
        public String toComponent(ApplicationData<?> input) {
            if (input.value() instanceof TextLine line && line.text().indexOf('\n') < 0) {
                return line.text();
            }
            throw new IllegalArgumentException(input + " is no line of text");
        }
    }
}
