package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSettings.Overflow;
import io.troupe.actor.testkit.TestSpace;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CancellationException;
import java.util.function.Consumer;
import org.junit.jupiter.api.Test;

class CallbackTest extends InTestSpace {
    /** What an actor does with a callback. */
    interface Use {
        void of(Callback<Integer> results);
    }

    interface Source {
        void give(Callback<Integer> results, Use use);

        default Promise<Integer> ask(Callback<Integer> results) {
            return Promise.of(1);
        }

        default void each(Consumer<Integer> consumer) {
            consumer.accept(8);
        }
    }

    private final List<Callback<Integer>> kept = new ArrayList<>();
    private final Source source = spawn(ActorSettings.defaults());

    private Source spawn(ActorSettings settings) {
        return test.spawn(Source.class, () -> (results, use) -> use.of(results), settings);
    }

    private void sendThree(Callback<Integer> results) {
        kept.add(results);
        for (int i = 0; i < 3; i++) {
            results.next(i);
        }
    }

    private class Reader extends Actor {
        public void read() {
            source.give((result, error) -> log.add("result " + result), CallbackTest.this::sendThree);
            log.add("asked");
            ((Reader) self()).mail();
        }

        public void mail() {
            log.add("mail");
        }
    }

    @Test
    void results_arriveInOrder_inTheCallersCallbackQueue_beforeItsMessages_untilItStops() {
        Reader reader = test.spawn(Reader.class, Reader::new);
        reader.read();
        test.runQueued();
        assertThat(log).containsExactly("asked", "result 0", "result 1", "result 2", "mail");
        stop(reader);
        test.run(() -> kept.getFirst().next(99));
        assertThat(log).hasSize(5);
        assertThat(kept.getFirst().isCancelled()).isTrue();
    }

    @Test
    void lambda_getsAnErrorAsThePaperHasIt() {
        Callback<Integer> lambda =
                (result, error) -> log.add(result + "/" + (error == null ? null : error.getMessage()));
        source.give(lambda, results -> {
            results.next(7);
            results.fail(new IllegalStateException("broken"));
        });
        test.runQueued();
        assertThat(log).containsExactly("7/null", "null/broken");
    }

    private Callback.Stream<Integer> stream() {
        return new Callback.Stream<>(
                result -> log.add("next " + result),
                end -> log.add("end " + (end == null ? null : end.getClass().getSimpleName())));
    }

    @Test
    void stream_isNotifiedOfItsEnd() {
        source.give(stream(), results -> {
            results.next(7);
            results.finish();
        });
        test.runQueued();
        assertThat(log).containsExactly("next 7", "end null");
    }

    @Test
    void cancelledStream_getsNothingMore_andTheActorSeesIt() {
        var stream = stream();
        source.give(stream, this::sendThree);
        test.runQueued();
        stream.cancel();
        assertThat(kept.getFirst().isCancelled()).isTrue();
        source.give(stream, results -> {
            log.add("cancelled: " + results.isCancelled());
            results.next(100);
        });
        test.runQueued();
        String end = "end " + CancellationException.class.getSimpleName();
        assertThat(log).containsExactly("next 0", "next 1", "next 2", end, "cancelled: true");
    }

    @Test
    void resultAfterTheEnd_isAnErrorOfTheSender() {
        source.give((result, error) -> {}, results -> {
            results.finish();
            results.next(1);
        });
        test.runQueued();
        assertThat(test.takeProblems())
                .singleElement()
                .satisfies(problem -> assertThat(problem.error())
                        .isInstanceOf(IllegalStateException.class)
                        .hasMessageContaining("nothing can follow"));
    }

    @Test
    void callback_givenToAnActorThatHasStopped_isFailed_butOneThatItHadStaysOpen() {
        var results = test.<Integer>callback();
        source.give(results, callback -> callback.next(0));
        test.space().stop(source);
        assertThat(results.results()).containsExactly(0);
        results.expectOpen();
        source.give((result, error) -> log.add("stream: " + error), this::sendThree);
        Promise<Integer> answer = source.ask((result, error) -> log.add("request: " + error));
        assertThat(test.error(answer)).isInstanceOf(ActorStoppedException.class);
        assertThat(log)
                .satisfiesExactly(
                        first -> assertThat(first).contains("stream: ", "ActorStoppedException", "was not begun"),
                        second -> assertThat(second).contains("request: ", "ActorStoppedException", "was not begun"));
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void callback_ofACallThatAFullMailboxRejectsOrACancelSkips_isFailed() {
        Source small = spawn(ActorSettings.defaults().withMailbox(1, Overflow.REJECT));
        Promise<Integer> taken = small.ask((result, error) -> log.add("first: " + error));
        small.give((result, error) -> log.add("second: " + error), this::sendThree);
        taken.cancel();
        test.runQueued();
        assertThat(log) // the second is a callback, which does not wait for messages
                .satisfiesExactly(
                        second -> assertThat(second).contains("second: ", "MailboxFullException"),
                        first -> assertThat(first).contains("first: ", "CancellationException", "before it began"));
        assertThat(test.takeDeadLetters()).hasSize(1);
    }

    @Test
    void dropOldest_keepsNoMoreThanItsCapacityQueued() {
        Source small = spawn(ActorSettings.defaults().withMailbox(3, Overflow.DROP_OLDEST));
        for (int call = 0; call < 1000; call++) {
            small.give((result, error) -> {}, kept::add);
        }
        assertThat(test.takeDeadLetters()).hasSize(997);
        assertThat(test.space().metrics().waiting() - 997).isEqualTo(3); // and 997 queued callbacks of rejected calls
        test.runQueued();
    }

    @Test
    void functionalArgument_runsOnTheActorsBehalf_unlessItIsACallback() {
        Source named = spawn(ActorSettings.named("source"));
        Doer reader = test.spawn(Doer.class, Doer::new, ActorSettings.named("reader"));
        reader.run(me -> {
            Consumer<Integer> noteOwner = result -> log.add(
                    result + " on behalf of " + me.context().space().home.owner());
            named.each(noteOwner);
            named.give((result, error) -> noteOwner.accept(result), results -> results.next(0));
        });
        test.runQueued();
        assertThat(log).containsExactly("8 on behalf of source", "0 on behalf of reader");
    }

    // ---- which parameters are callbacks

    interface Harmless<T extends Comparable<T>> {
        <U extends Comparable<U>> void sort(
                List<U> values, T most, Map<String, ? super T[]> least, List<String>[] names);

        void both(Callback<? super List<Integer>> first, @SuppressWarnings("rawtypes") Callback second);
    }

    @Test
    void otherGenericParameters_areNotRejected() {
        Harmless<?> proxy = test.spawn(Harmless.class, () -> null);
        assertThat(proxy).hasToString("Harmless#2");
        assertThat(test.takeProblems()).hasSize(1); // the factory
    }

    interface Follower<T> {
        void wander(String where, T colours);
    }

    interface Overriding extends Follower<Callback<Integer>> {
        @Override
        void wander(String where, Callback<Integer> colours);
    }

    interface Walking {
        void wander(String where, Callback<Integer> colours);
    }

    /** The descriptor with Object is inherited here a second time, and the compiler has generated no bridge. */
    interface Twice extends Follower<Callback<Integer>>, Walking {}

    abstract static class Wanderer<T> extends Actor {
        public void wander(String where, T colours) {}
    }

    public static class Robot extends Wanderer<Callback<Integer>> {
        @Override
        public void wander(String where, Callback<Integer> colours) {
            colours.next(9);
        }
    }

    @Test
    void callbackThroughAGenericSupertype_runsInTheCallersSpace() {
        try (var callee = new TestSpace()) {
            Overriding overriding = callee.spawn(Overriding.class, () -> (where, colours) -> colours.next(7));
            Twice twice = callee.spawn(Twice.class, () -> new Twice() {
                @Override
                public void wander(String where, Callback<Integer> colours) {
                    colours.next(8);
                }
            });
            Wanderer<Callback<Integer>> robot = callee.spawn(Robot.class, Robot::new);
            Callback<Integer> seen = (colour, error) -> log.add("" + colour);
            for (Follower<Callback<Integer>> follower : List.of(overriding, twice)) {
                test.run(() -> follower.wander("here", seen));
            }
            test.run(() -> robot.wander("here", seen));
            test.run(() -> ((Walking) twice).wander("here", seen));
            callee.runQueued();
            assertThat(log).isEmpty();
            test.runQueued();
            assertThat(log).containsExactlyInAnyOrder("7", "8", "8", "9");
        }
    }

    @Test
    void callbackOfTheWrongClass_throwsInTheCaller() {
        Overriding overriding = test.spawn(Overriding.class, () -> (where, colours) -> colours.next(7));
        @SuppressWarnings({"unchecked", "rawtypes"}) // on purpose
        Consumer<Object> raw = colours -> ((Follower) overriding).wander("here", colours);
        assertThatThrownBy(() -> raw.accept("no callback")).isInstanceOf(ClassCastException.class);
    }
}
