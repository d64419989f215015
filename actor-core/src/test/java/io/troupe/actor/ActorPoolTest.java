package io.troupe.actor;

import static io.troupe.actor.Concurrently.LONG;
import static io.troupe.actor.Concurrently.await;
import static io.troupe.actor.Concurrently.onThreads;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.testkit.CallbackProbe;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.concurrent.CancellationException;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.stream.IntStream;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** Which actors of a pool receive a call, and that they run at the same time. */
class ActorPoolTest extends InTestSpace {
    private static final int SIZE = 3;

    private final AtomicInteger made = new AtomicInteger();
    private final List<ActorSpace> spaces = IntStream.range(0, SIZE)
            .mapToObj(number ->
                    ActorSpace.create(SpaceSettings.named("space-" + number).withoutThread()))
            .toList();
    private final ActorPool<Worker> pool =
            ActorPool.on(spaces, Worker.class, () -> new Working(made.getAndIncrement()), ActorSettings.defaults());

    /** Has a generic parent, overloads and arguments of two slots. */
    interface Parent<K> {
        Promise<Integer> key(K key);
    }

    interface Worker extends Parent<String> {
        void note(String text);

        void note(long first, double second, String third);

        Promise<Integer> number();

        Promise<Integer> fail(int number);

        Promise<Integer> later(Promise<Integer> answer);

        void count(Callback<Integer> numbers);

        default String local() {
            return "local";
        }
    }

    private class Working implements Worker {
        private final int number;

        Working(int number) {
            this.number = number;
        }

        @Override
        public Promise<Integer> key(String key) {
            return number();
        }

        @Override
        public void note(String text) {
            log.add(number + " " + text);
        }

        @Override
        public void note(long first, double second, String third) {
            note(first + " " + second + " " + third);
        }

        @Override
        public Promise<Integer> number() {
            return Promise.of(number);
        }

        @Override
        public Promise<Integer> fail(int which) {
            return which == number ? Promise.failed(new IllegalStateException("failed " + number)) : number();
        }

        @Override
        public Promise<Integer> later(Promise<Integer> answer) {
            return answer;
        }

        @Override
        public void count(Callback<Integer> numbers) {
            numbers.next(number);
        }
    }

    private void runQueued() {
        for (int round = 0; round < 3; round++) {
            test.runQueued();
            spaces.forEach(ActorSpace::runQueued);
        }
        test.runQueued();
    }

    private <T> @Nullable T get(Promise<T> promise) {
        runQueued();
        return promise.getNow();
    }

    @AfterEach
    void closeSpaces() {
        spaces.forEach(ActorSpace::close);
    }

    @Test
    void roundRobin_givesEachActorItsTurn() {
        runQueued();
        List<Integer> numbers = new ArrayList<>();
        for (int call = 0; call < 2 * SIZE; call++) {
            numbers.add(get(pool.roundRobin().number()));
        }
        assertThat(numbers).containsExactly(0, 1, 2, 0, 1, 2);
    }

    @Test
    void byFirstArgument_sendsEqualKeysToOneActor_andUsesAllOfThem() {
        Map<String, Integer> actors = new HashMap<>();
        for (int key = 0; key < 300; key++) {
            String name = "robot " + key % 100;
            Integer actor = get(pool.byFirstArgument().key(name));
            assertThat(actors.merge(name, actor, (before, now) -> before)).isEqualTo(actor);
            assertThat(get(pool.actor(name).number())).isEqualTo(actor);
        }
        for (int actor = 0; actor < SIZE; actor++) {
            int mine = actor;
            assertThat(actors.values()).filteredOn(each -> each == mine).hasSizeBetween(15, 55);
        }
    }

    @Test
    void byFirstArgument_takesPrimitivesAndNull_andRefusesACallWithoutArguments() {
        pool.byFirstArgument().note(7, 0.5, "x");
        pool.byFirstArgument().note(7, 0.25, "y");
        pool.byFirstArgument().note(null);
        runQueued();
        assertThat(log).extracting(line -> line.substring(2)).containsExactlyInAnyOrder("7 0.5 x", "7 0.25 y", "null");
        assertThat(log.stream()
                        .filter(line -> line.contains(" 7 "))
                        .map(line -> line.charAt(0))
                        .distinct())
                .hasSize(1);
        assertThatThrownBy(() -> pool.byFirstArgument().number())
                .isInstanceOf(UnsupportedOperationException.class)
                .hasMessageStartingWith("Worker.number() has no argument by which one of the actors");
    }

    @Test
    void broadcast_reachesAll_andAnswersWhenAllHave_orWithTheFirstError() {
        pool.broadcast().note("all");
        runQueued();
        assertThat(log).containsExactlyInAnyOrder("0 all", "1 all", "2 all");
        assertThat(get(pool.broadcast().number())).isZero();
        var answer = new Deferred<Integer>();
        Promise<Integer> whole = pool.broadcast().later(answer);
        assertThat(get(whole)).isNull();
        answer.resolve(5);
        assertThat(get(whole)).isEqualTo(5);
        Promise<Integer> failing = pool.broadcast().fail(1);
        failing.handle((value, error) -> error);
        runQueued();
        assertThat(failing.error()).hasMessage("failed 1");
    }

    @Test
    void callback_receivesTheResultsOfAll_onTheCallersSpace() {
        CallbackProbe<Integer> numbers = test.callback();
        test.run(() -> pool.broadcast().count(numbers));
        runQueued();
        assertThat(numbers.results()).containsExactlyInAnyOrder(0, 1, 2);
    }

    private void stopMember(int number) {
        Worker actor = pool.actors().get(number);
        ActorSpace.of(actor).stop(actor);
        runQueued();
    }

    @Test
    void roundRobin_passesOverActorsThatHaveStopped_withEqualSharesForTheOthers() {
        assertThat(pool.living()).isEqualTo(3);
        stopMember(1);
        assertThat(pool.living()).isEqualTo(2);
        List<Integer> numbers = new ArrayList<>();
        for (int call = 0; call < 6; call++) {
            numbers.add(get(pool.roundRobin().number()));
        }
        assertThat(numbers).containsExactly(0, 2, 0, 2, 0, 2);
    }

    @Test
    void byFirstArgument_movesOnlyTheKeysOfAnActorThatHasStopped_toAllOthers() {
        List<String> keys =
                IntStream.range(0, 300).mapToObj(key -> "robot " + key).toList();
        Map<String, Integer> before = actorsOf(keys);
        stopMember(1);
        Map<String, Integer> after = actorsOf(keys);
        assertThat(after).allSatisfy((key, actor) -> {
            int mine = before.get(key);
            assertThat(actor).isNotEqualTo(1);
            assertThat(mine == 1 || mine == actor).as(key).isTrue();
        });
        long moved = before.values().stream().filter(actor -> actor == 1).count();
        assertThat(keys.stream().filter(key -> before.get(key) == 1 && after.get(key) == 0))
                .hasSizeBetween((int) moved / 4, (int) moved * 3 / 4);
        stopMember(0);
        assertThat(actorsOf(keys).values()).containsOnly(2);
    }

    /** Which actor has each key; also that {@code actor(key)} answers that one. */
    private Map<String, Integer> actorsOf(List<String> keys) {
        Map<String, Integer> actors = new HashMap<>();
        for (String key : keys) {
            Integer actor = get(pool.byFirstArgument().key(key));
            assertThat(get(pool.actor(key).number())).isEqualTo(actor);
            actors.put(key, actor);
        }
        return actors;
    }

    @Test
    void broadcast_reachesThoseThatLive() {
        stopMember(0);
        assertThat(get(pool.broadcast().number())).isEqualTo(1);
        pool.broadcast().note("all");
        runQueued();
        assertThat(log).containsExactlyInAnyOrder("1 all", "2 all");
    }

    @Test
    void call_ofAPoolWhoseActorsHaveAllStopped_isRejectedWithTheNameOfThePool() {
        List<DeadLetter> letters = new ArrayList<>();
        List<ActorSpace> own = IntStream.range(0, 2)
                .mapToObj(number -> ActorSpace.create(SpaceSettings.named("own-" + number)
                        .withOnDeadLetter(letters::add)
                        .withoutThread()))
                .toList();
        var ended = ActorPool.on(own, Worker.class, () -> new Working(0), ActorSettings.named("smith"));
        ended.close();
        own.forEach(ActorSpace::runQueued);
        assertThat(ended.living()).isZero();
        CallbackProbe<Integer> numbers = test.callback();
        for (Worker proxy : List.of(ended.roundRobin(), ended.byFirstArgument(), ended.broadcast(), ended.actor("x"))) {
            Promise<Integer> answer = proxy.fail(1);
            answer.handle((value, error) -> error);
            proxy.note("lost");
            own.forEach(ActorSpace::runQueued);
            assertThat(answer.error())
                    .isInstanceOf(ActorStoppedException.class)
                    .hasMessage(
                            "Worker.fail(int) of pool of 2 smith was not begun: all actors of the pool of 2 smith have stopped");
        }
        test.run(() -> ended.broadcast().count(numbers));
        own.forEach(ActorSpace::runQueued);
        assertThat(numbers.expectFailed()).hasMessageContaining("pool of 2 smith");
        assertThat(letters).hasSize(5).first().extracting(DeadLetter::actor).isEqualTo("pool of 2 smith");
        own.forEach(ActorSpace::close);
    }

    @Test
    void create_takesSettingsOfTheActors_andARestartedActorKeepsItsPlace() throws Exception {
        var starts = new AtomicInteger();
        var settings = ActorSettings.named("smith").withSupervision(Supervision.restart(1, Duration.ofHours(1)));
        try (var smiths = ActorPool.create(
                1,
                SpaceSettings.named("forge").withOnError((where, error) -> log.add(error.getMessage())),
                Poisoned.class,
                () -> () -> {
                    throw new IllegalStateException("poisoned " + starts.incrementAndGet());
                },
                settings)) {
            ActorSpace space = smiths.spaces().getFirst();
            Promise<ActorEnd> end = space.whenStopped(smiths.actors().getFirst());
            smiths.roundRobin().swallow();
            smiths.roundRobin().swallow();
            assertThat(end.get(LONG).toString()).contains("poisoned 2");
            assertThat(smiths.living()).isZero();
            assertThat(smiths).hasToString("pool of [smith]");
        }
    }

    interface Poisoned {
        void swallow();
    }

    /** Keeps its callback. */
    private static final class Source implements Watched {
        private @Nullable Callback<Integer> numbers;

        @Override
        public void watch(Callback<Integer> next) {
            numbers = next;
        }

        @Override
        public Promise<Integer> ask(Callback<Integer> next) {
            numbers = next;
            return Promise.of(1);
        }
    }

    interface Watched {
        void watch(Callback<Integer> next);

        Promise<Integer> ask(Callback<Integer> next);
    }

    private final List<Source> sources = new ArrayList<>();

    private ActorPool<Watched> watched() {
        return ActorPool.on(
                spaces,
                Watched.class,
                () -> {
                    var source = new Source();
                    sources.add(source);
                    return source;
                },
                ActorSettings.defaults());
    }

    private Callback<Integer> given(int actor) {
        return Objects.requireNonNull(sources.get(actor).numbers);
    }

    @Test
    void callbackOfABroadcast_endsWithTheLastActor_andReceivesAllResults() {
        CallbackProbe<Integer> numbers = test.callback();
        test.run(() -> watched().broadcast().watch(numbers));
        runQueued();
        for (int actor = 0; actor < SIZE; actor++) {
            numbers.expectOpen();
            given(actor).next(actor);
            given(actor).finish();
            runQueued();
        }
        assertThat(numbers.results()).containsExactly(0, 1, 2);
        numbers.expectFinished();
        assertThatThrownBy(() -> given(0).next(3)).hasMessageContaining("finished or failed before");
    }

    @Test
    void callbackOfABroadcast_endsWithTheFirstError_andTheOtherActorsSeeThat() {
        CallbackProbe<Integer> numbers = test.callback();
        test.run(() -> watched().broadcast().watch(numbers));
        runQueued();
        given(0).next(1);
        given(1).fail(new IllegalStateException("no light"));
        assertThat(given(0).isCancelled()).isTrue();
        given(0).next(2);
        given(0).finish();
        given(2).fail(new IllegalStateException("later"));
        runQueued();
        assertThat(numbers.results()).containsExactly(1);
        assertThat(numbers.expectFailed()).hasMessage("no light");
    }

    @Test
    void callbackOfABroadcast_thatAnActorRejects_fails() {
        CallbackProbe<Integer> numbers = test.callback();
        var watched = watched();
        Watched second = watched.actors().get(1);
        ActorSpace.of(second).stop(second); // the call comes behind this
        test.run(() -> watched.broadcast().watch(numbers));
        runQueued();
        assertThat(numbers.expectFailed()).isInstanceOf(ActorStoppedException.class);
    }

    @Test
    void callbackOfABroadcast_whoseCallIsCancelledInTheMailbox_fails() {
        CallbackProbe<Integer> numbers = test.callback();
        test.run(() -> watched().broadcast().ask(numbers).cancel());
        runQueued();
        assertThat(numbers.expectFailed()).isInstanceOf(CancellationException.class);
        assertThat(sources)
                .as("actors that have begun it")
                .filteredOn(each -> each.numbers != null)
                .isEmpty();
    }

    @Test
    void streamOfABroadcast_keepsItsCapacity_andItsCancellationIsSeenByAll() {
        List<Object> seen = new ArrayList<>();
        var stream = new Callback.Stream<Integer>(2, seen::add, end -> seen.add("end"));
        test.run(() -> watched().broadcast().watch(stream));
        runQueued();
        for (int number = 0; number < 9; number++) {
            given(number % SIZE).next(number);
        }
        runQueued();
        assertThat(seen).containsExactly(7, 8);
        stream.cancel();
        assertThat(given(0).isCancelled() && given(1).isCancelled() && given(2).isCancelled())
                .isTrue();
        runQueued();
        assertThat(seen).containsExactly(7, 8, "end");
    }

    @Test
    void callbackOfABroadcast_fromOutside_runsOnOneSpace_andMayBePassedOn() {
        List<Object> seen = new ArrayList<>();
        watched()
                .broadcast()
                .watch(new Callback.Stream<>(
                        number -> seen.add(number + " on " + ActorSpace.current()), end -> seen.add("end")));
        runQueued();
        for (int actor = 0; actor < SIZE; actor++) {
            Callback<Integer> mine = given(actor);
            spaces.get(actor).execute(() -> pool.roundRobin().count(mine)); // the share of this actor goes on
        }
        runQueued();
        assertThat(seen).containsExactlyInAnyOrder("0 on space-0", "1 on space-0", "2 on space-0");
        for (int actor = 0; actor < SIZE; actor++) {
            given(actor).finish();
        }
        runQueued();
        assertThat(seen).last().isEqualTo("end");
    }

    interface Store {
        void put(byte[] key, String value);

        Promise<String> find(String name);
    }

    interface AnyKey<K> {
        void put(K key);
    }

    interface Files extends AnyKey<Object> {}

    @Test
    void byFirstArgument_refusesArrays_asTheyAreNotEqual() {
        var stores = ActorPool.on(spaces, Store.class, () -> null, ActorSettings.defaults());
        assertThatThrownBy(stores::byFirstArgument)
                .isInstanceOf(ActorTypeException.class)
                .hasMessage("Store.put(byte[], String) of actor type " + Store.class.getName()
                        + " has an array as its first argument, by which byFirstArgument() cannot choose, because"
                        + " arrays with equal contents are not equal: let a String, number or record come first, or"
                        + " call actor(key)");
        assertThatThrownBy(() -> pool.actor(new byte[1]))
                .hasMessage("the key is an array, byte[], expected a value whose equals(..) compares contents: "
                        + "a String, number or record");
        var files = ActorPool.on(spaces, Files.class, () -> null, ActorSettings.defaults());
        assertThatThrownBy(() -> files.byFirstArgument().put(new int[1])).hasMessageContaining("the key is an array");
    }

    @Test
    void proxies_haveWhatOtherProxiesHave() {
        assertThat(pool.roundRobin().local()).isEqualTo("local");
        Parent<String> asParent = pool.roundRobin();
        assertThat(get(asParent.key("x"))).isNotNull();
        assertThat(pool.roundRobin()).hasToString("round robin of [Worker#1, Worker#1, Worker#1]");
        assertThat(pool).hasToString("pool of [Worker#1, Worker#1, Worker#1]");
        assertThat(pool.roundRobin()).isEqualTo(pool.roundRobin()).isNotEqualTo(pool.broadcast());
        assertThatThrownBy(() -> spaces.getFirst().stop(pool.roundRobin())).hasMessageContaining("not a proxy");
    }

    static class ClassActor extends Actor {
        private final List<String> texts = new ArrayList<>();

        public void put(String text) {
            texts.add(text);
        }

        public Promise<List<String>> texts() {
            return Promise.of(texts);
        }

        void hidden() {}
    }

    @Test
    void classActors_canBePooled_andTheirProxiesRefuseWhatIsNoMessage() {
        try (var classes = ActorPool.on(spaces, ClassActor.class, ClassActor::new, ActorSettings.defaults())) {
            classes.roundRobin().put("a");
            classes.roundRobin().put("b");
            List<Promise<List<String>>> texts =
                    classes.actors().stream().map(ClassActor::texts).toList();
            runQueued();
            assertThat(texts).extracting(Promise::getNow).containsExactly(List.of("a"), List.of("b"), List.of());
            assertThatThrownBy(() -> classes.roundRobin().hidden()).isInstanceOf(IllegalStateException.class);
            assertThatThrownBy(() -> classes.roundRobin().started()).isInstanceOf(IllegalStateException.class);
        }
        runQueued();
        assertThat(pool.spaces())
                .allSatisfy(space -> assertThat(space.metrics().actors()).isOne());
    }

    @Test
    void poolWithoutSpaces_orOfNoActorType_isRejected() {
        assertThatThrownBy(() -> ActorPool.create(0, SpaceSettings.named("none"), Worker.class, () -> new Working(0)))
                .hasMessage("size is 0, expected 1 or more");
        assertThatThrownBy(() -> ActorPool.on(List.of(), Worker.class, () -> new Working(0), ActorSettings.defaults()))
                .hasMessage("spaces is empty, expected one or more");
        assertThatThrownBy(() -> ActorPool.create(1, SpaceSettings.named("none"), Comparable.class, () -> "a"))
                .isInstanceOf(ActorTypeException.class);
    }

    interface Meeting {
        Promise<String> meet();
    }

    /** Each waits within its turn for all others, so they can only return if they run at the same time. */
    @Test
    @Tag("threads")
    @Timeout(60)
    void actors_runAtTheSameTime_eachOnItsThread_untilThePoolIsClosed() throws Exception {
        var all = new CountDownLatch(SIZE);
        Meeting last;
        try (var meetings = ActorPool.create(SIZE, SpaceSettings.named("room"), Meeting.class, () -> () -> {
            all.countDown();
            await(all);
            return Promise.of(Thread.currentThread().getName());
        })) {
            List<Promise<String>> names = IntStream.range(0, SIZE)
                    .mapToObj(call -> meetings.roundRobin().meet())
                    .toList();
            assertThat(Promise.all(names).get(LONG)).containsExactly("room-0", "room-1", "room-2");
            last = meetings.roundRobin();
        }
        assertThat(last.meet().error()).isInstanceOf(ActorStoppedException.class);
    }

    interface Counter {
        void add(Integer sender, int number);

        Promise<Map<Integer, Integer>> inOrder();
    }

    /** Notes the last number of each sender, or -1 once one came out of order. */
    private static final class Counting implements Counter {
        private final Map<Integer, Integer> last = new HashMap<>();

        @Override
        public void add(Integer sender, int number) {
            last.merge(sender, number, (before, next) -> next == before + 1 ? next : -1);
        }

        @Override
        public Promise<Map<Integer, Integer>> inOrder() {
            return Promise.of(Map.copyOf(last));
        }
    }

    @Test
    @Tag("threads")
    @Timeout(60)
    void callsOfOneKey_keepTheirOrder_andAllArrive() throws Exception {
        try (var pooled = ActorPool.create(2, SpaceSettings.named("keys"), Counter.class, Counting::new)) {
            onThreads(
                    4,
                    sender -> IntStream.range(0, 20_000)
                            .forEach(number -> pooled.byFirstArgument().add(sender, number)));
            Map<Integer, Integer> last = new ConcurrentHashMap<>();
            for (Counter counter : pooled.actors()) {
                last.putAll(counter.inOrder().get(LONG));
            }
            assertThat(last)
                    .hasSize(4)
                    .allSatisfy((sender, number) -> assertThat(number).isEqualTo(19_999));
        }
    }
}
