package io.troupe.services.component.kinds;

import io.troupe.services.bus.BusTopic;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.Conversion;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

/**
 * A process of the operating system as a component: a program in any language that reaches the robots by itself, by the
 * Player protocol for example.
 *
 * <p><b>Role.</b> Control signals: it is started by its command line, runs from the first line it writes to its
 * standard output, and is ended, with the processes that it has started, as the system does that. Data signals are
 * lines of text: under the name {@code c} it hears {@code c/in} on its standard input, and each line of its standard
 * output is said as {@code c/out}, cut after 65,536 characters.
 *
 * <p><b>Processes.</b> On Linux, where there is the command {@code setsid}, the program leads a session, without a
 * terminal, and every process of the session ends with it: when it is terminated, when it ends by itself, and when this
 * virtual machine shuts down: then an application has 2 s to stop its components in its own order, before the processes
 * that are left are ended. A virtual machine that is killed ({@code kill -9}, {@code Runtime.halt}, a crash) ends none:
 * a program that must not go on alone ends at the end of its standard input, or when its connection with the server has
 * gone. One that opens a session itself, as a daemon does, lives on if its parent has ended, and so do, where there is
 * no {@code setsid}, processes whose parent has ended.
 *
 * <p><b>Errors.</b> It has failed when it ends by itself, which is reported when the processes that it had started have
 * ended, too; the error has its exit status and the end of what it wrote to its standard error. A termination is
 * rejected with the processes that are left if some are alive 10 s after they were killed. What it moved over a
 * connection of its own is for the server to stop: ours does when nobody has the robot open any more.
 *
 * <p><b>Source.</b> Paper, section 2.1.1: packages may be built in different programming languages.
 */
public final class ProcessComponent {
    /** A line of text, without its end. */
    public record TextLine(String text) {}

    /**
     * What is run.
     *
     * @param command the program and its arguments
     * @param directory where it runs
     * @param startLimit how long it may take to its first line
     * @param stopLimit how long it may take to end when it is asked to, before it is killed
     */
    public record Settings(List<String> command, Path directory, Duration startLimit, Duration stopLimit) {
        public Settings {
            command = List.copyOf(command);
            if (command.isEmpty()) {
                throw new IllegalArgumentException("the command of a process is empty, expected a program");
            }
        }

        /** With 10 s to start and 2 s to stop, by the machine's clock. */
        public static Settings of(List<String> command, Path directory) {
            return new Settings(command, directory, Duration.ofSeconds(10), Duration.ofSeconds(2));
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
