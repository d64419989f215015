package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.promise.Deferred;
import io.troupe.actor.promise.Promise;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.function.Consumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

/** The statements of docs/guide/12-differences.md that no other test checks. */
class DifferencesTest {
    interface Source {
        void each(Consumer<String> consumer);

        void stream(Callback<String> results);

        void end();
    }

    interface Bag<T> {
        Promise<Integer> put(T what);
    }

    private static final class Letters extends Actor implements Source {
        @Override
        public void each(Consumer<String> consumer) {
            consumer.accept("a");
        }

        @Override
        public void stream(Callback<String> results) {
            results.next("a");
        }

        @Override
        public void end() {
            stop();
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
            source.each(
                    letter -> log.add(letter + " on behalf of " + space().home.owner()));
            source.stream((letter, error) ->
                    log.add(letter + " on behalf of " + space().home.owner()));
        }
    }

    private final TestSpace test = new TestSpace();
    private final List<String> log = new ArrayList<>();

    @AfterEach
    void nothingIsLeft() {
        test.close();
    }

    @Test
    void functionalArgument_runsOnTheActorsBehalf_unlessItIsACallback() {
        Source source = test.spawn(Source.class, Letters::new, ActorSettings.named("source"));
        Reader reader = test.spawn(Reader.class, () -> new Reader(source, log), ActorSettings.named("reader"));
        reader.read();
        test.crank();
        assertThat(log).containsExactly("a on behalf of source", "a on behalf of reader");
    }

    @Test
    void callbackOfAnActorThatStops_staysOpen() {
        Source source = test.spawn(Source.class, Letters::new);
        var results = test.<String>callback();
        source.stream(results);
        source.end();
        assertThat(results.results()).containsExactly("a");
        results.expectOpen();
    }

    @Test
    @SuppressWarnings({"unchecked", "rawtypes"}) // the mistake
    void wrongTypeByARawProxy_rejectsTheRequest() {
        Bag<String> bag = test.spawn(Bag.class, () -> (Bag<String>) what -> Promise.of(what.length()));
        Bag raw = bag;
        assertThat(test.error(raw.put(1))).isInstanceOf(ClassCastException.class);
        assertThat(test.get(bag.put("four"))).isEqualTo(4);
    }

    @Test
    void thenCombine_passesTheFirstErrorOn_withoutTheOther() {
        var never = new Deferred<String>(test.space());
        Promise<String> both =
                Promise.<String>failed(new IllegalStateException("first")).thenCombine(never, String::concat);
        assertThat(test.error(both)).hasMessage("first");
    }

    @Test
    void anyOfNothing_isRejected() {
        assertThat(test.error(Promise.any(List.of()))).isInstanceOf(NoSuchElementException.class);
    }
}
