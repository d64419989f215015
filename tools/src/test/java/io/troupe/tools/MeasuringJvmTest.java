package io.troupe.tools;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.FutureTask;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

@Timeout(60)
class MeasuringJvmTest {
    /** Main class of the child JVMs of these tests. */
    static final class Child {
        private Child() {}

        public static void main(String[] arguments) throws Exception {
            MeasuringJvm.serve(() -> {
                System.out.println("printed while the handler is created");
                if (List.of(arguments).contains("broken")) {
                    throw new IllegalStateException("it cannot begin");
                }
                return Child::answer;
            });
        }

        private static List<String> answer(String request) throws InterruptedException {
            System.out.println("printed during a request");
            return switch (request.split(" ")[0]) {
                case "repeat" -> Collections.nCopies(Integer.parseInt(request.split(" ")[1]), "failed µ");
                case "fail" -> throw new IllegalArgumentException("two\nlines");
                case "exit" -> throw new AssertionError("an error ends the child");
                case "hang" -> {
                    new CountDownLatch(1).await();
                    yield List.of();
                }
                default -> List.of(request);
            };
        }
    }

    @TempDir
    private Path directory;

    private MeasuringJvm.Settings child(String... arguments) {
        return MeasuringJvm.running(Child.class, arguments)
                .withOptions("-Xmx64m")
                .withLog(log());
    }

    private Path log() {
        return directory.resolve("log");
    }

    @Test
    void answer_hasAnyNumberOfLines_andNothingThatTheChildPrints() throws IOException {
        try (var jvm = child().start()) {
            assertThat(jvm.ask("repeat 0")).isEmpty();
            assertThat(jvm.ask("once")).containsExactly("once");
            assertThat(jvm.ask("repeat 3")).containsExactly("failed µ", "failed µ", "failed µ");
        }
        assertThat(log()).content().contains("printed while the handler is created", "printed during a request");
    }

    private static void assertFails(MeasuringJvm jvm, String request, String message) {
        assertThatThrownBy(() -> jvm.ask(request))
                .isInstanceOf(IOException.class)
                .hasMessage(message);
    }

    @Test
    void requestThatFails_isReportedWithItsReason_andTheNextOneIsAnswered() throws IOException {
        try (var jvm = child().withLimit(Duration.ofSeconds(50)).start()) {
            assertThatThrownBy(() -> jvm.ask("fail", "the first job"))
                    .isInstanceOf(IOException.class)
                    .hasMessage("the first job: java.lang.IllegalArgumentException: two lines");
            assertThat(jvm.ask("next")).containsExactly("next");
        }
    }

    @Test
    void jvmThatEnds_orCannotBegin_isReportedWithItsStatusAtTheRequest() throws IOException {
        try (var jvm = child().withProcessors(2).start()) {
            assertFails(
                    jvm, "exit", "exit: the JVM that measures (told 2 cores) has ended: exit status 1, see " + log());
        }
        assertThat(log()).content().contains("AssertionError: an error ends the child");
        try (var jvm = child("broken").start()) {
            assertFails(jvm, "once", "once: the JVM that measures has ended: exit status 1, see " + log());
        }
        assertThat(log()).content().contains("it cannot begin");
    }

    /** A late answer would be taken for the answer to the next request. */
    @Test
    void jvmThatHangs_isReportedAndKilledAfterItsLimit_andAnswersNothingAfterClose() throws Exception {
        var jvm = child().withLimit(Duration.ofMillis(1)).start();
        List<ProcessHandle> children = ProcessHandle.current().children().toList();
        assertThat(children).isNotEmpty();
        assertFails(jvm, "hang", "hang: the JVM that measures did not answer in 0 s, see " + log());
        for (ProcessHandle child : children) {
            child.onExit().get();
        }
        jvm.close();
        assertThatThrownBy(() -> jvm.ask("again")).isInstanceOf(IOException.class);
    }

    @Test
    void end_killsAJvmThatAnswersARequest() throws IOException {
        try (var jvm = child().start()) {
            var asking = new FutureTask<>(() -> jvm.ask("hang"));
            Thread.ofPlatform().start(asking);
            jvm.end();
            assertThatThrownBy(asking::get).hasCauseInstanceOf(IOException.class);
        }
    }

    /** Two values, of which at most one is the number of processors of this machine. */
    @ParameterizedTest
    @ValueSource(ints = {1, 5})
    void processors_areThoseOfTheSettings(int processors) throws IOException {
        var settings = child().withProcessors(processors);
        try (var jvm = settings.start()) {
            assertThat(jvm.ask("once")).containsExactly("once"); // refused if the child reports another number
        }
        int others = processors + 1;
        try (var jvm =
                settings.withOptions("-XX:ActiveProcessorCount=" + others).start()) {
            assertFails(
                    jvm,
                    "once",
                    "the JVM that measures reports " + others + " processors, expected " + processors
                            + " as its options specify, see " + log());
        }
    }
}
