package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CancellationException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

class CallbackTest {
    interface Source {
        void send(int count, Callback<Integer> results);

        void finishWith(Callback<Integer> results, String error);
    }

    static final class Counting implements Source {
        private final List<Callback<Integer>> kept = new ArrayList<>();
        private int sent;

        @Override
        public void send(int count, Callback<Integer> results) {
            for (int i = 0; i < count && !results.isCancelled(); i++) {
                results.next(i);
                sent++;
            }
            kept.add(results);
        }

        @Override
        public void finishWith(Callback<Integer> results, String error) {
            results.next(7);
            if (error == null) {
                results.finish();
            } else {
                results.fail(new IllegalStateException(error));
            }
        }
    }

    public static class Reader extends Actor {
        private final Source source;
        private final List<String> log;

        Reader(Source source, List<String> log) {
            this.source = source;
            this.log = log;
        }

        public void read() {
            source.send(3, (result, error) -> log.add("result " + result));
            log.add("asked");
            ((Reader) self()).mail();
        }

        public void mail() {
            log.add("mail");
        }
    }

    private final TestSpace test = new TestSpace();
    private final Counting counting = new Counting();
    private final Source source = test.spawn(Source.class, () -> counting);
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void results_arriveInOrder_inTheCallersCallbackQueue_beforeItsMessages() {
        Reader reader = test.spawn(Reader.class, () -> new Reader(source, log));
        reader.read();
        test.crank();
        assertThat(log).containsExactly("asked", "result 0", "result 1", "result 2", "mail");
    }

    @Test
    void lambda_getsAnErrorAsThePaperHasIt() {
        source.finishWith(
                (result, error) -> log.add(result + "/" + (error == null ? null : error.getMessage())), "broken");
        test.crank();
        assertThat(log).containsExactly("7/null", "null/broken");
    }

    @Test
    void stream_isNotifiedOfItsEnd() {
        source.finishWith(
                new Callback.Stream<>(result -> log.add("next " + result), end -> log.add("end " + end)), null);
        test.crank();
        assertThat(log).containsExactly("next 7", "end null");
    }

    @Test
    void cancelledStream_getsNothingMore_andTheActorSeesIt() {
        var stream = new Callback.Stream<Integer>(
                result -> log.add("next " + result),
                end -> log.add("end " + end.getClass().getSimpleName()));
        source.send(2, stream);
        test.crank();
        stream.cancel();
        assertThat(counting.kept.getFirst().isCancelled()).isTrue();
        source.send(100, stream);
        test.crank();
        assertThat(counting.sent).isEqualTo(2);
        assertThat(log).containsExactly("next 0", "next 1", "end " + CancellationException.class.getSimpleName());
    }

    @Test
    void resultAfterTheEnd_isAnErrorOfTheSender() {
        source.send(0, (result, error) -> {});
        test.crank();
        test.run(() -> {
            counting.kept.getFirst().finish();
            counting.kept.getFirst().next(1);
        });
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error())
                        .isInstanceOf(IllegalStateException.class)
                        .hasMessageContaining("nothing can follow"));
    }

    @Test
    void readerThatHasStopped_looksCancelled() {
        Reader reader = test.spawn(Reader.class, () -> new Reader(source, log));
        reader.read();
        test.crank();
        test.space().stop(reader);
        test.crank();
        Callback<Integer> kept = counting.kept.getFirst();
        test.run(() -> kept.next(99));
        assertThat(log).doesNotContain("result 99");
        assertThat(kept.isCancelled()).isTrue();
    }
}
