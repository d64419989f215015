package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Actor;
import io.troupe.actor.ActorSettings;
import io.troupe.actor.Deferred;
import io.troupe.actor.Promise;
import io.troupe.actor.testkit.TestSpace;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import java.io.StringWriter;
import java.lang.invoke.MethodHandles;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.function.Supplier;
import javax.tools.ToolProvider;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** Wirings that were written from runs. */
class WiringRecorderTest {
    interface Client {
        void go();
    }

    interface Server {
        Promise<Integer> get();

        void put(int value);
    }

    private static class Serving extends Actor implements Server {
        @Override
        public Promise<Integer> get() {
            return Promise.of(1);
        }

        @Override
        public void put(int value) {}
    }

    private static void run(TestSpace test) {
        run(test, ActorSettings.named("server"), ActorSettings.named("client"));
    }

    private static void run(TestSpace test, ActorSettings ofServer, ActorSettings ofClient) {
        Server server = test.spawn(Server.class, Serving::new, ofServer);
        Client client = test.spawn(Client.class, () -> () -> server.get().then(got -> server.put(got)), ofClient);
        client.go();
        test.runQueued();
        client.go();
        test.runQueued();
    }

    @Test
    void recordedWiring_isProved_andAcceptsItsRun() {
        var recorder = new WiringRecorder("test");
        try (var test = new TestSpace(recorder)) {
            run(test);
        }
        assertThat(recorder.problems()).isEmpty();
        assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(Proved.class);
        var monitor = WiringMonitor.of(recorder.wiring());
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            run(test);
        }
        monitor.idle();
        monitor.check();
        assertThat(monitor.count()).isEqualTo(10);
    }

    // ---- answers that come later

    interface Account {
        Promise<Integer> pay(Account to);

        Promise<Integer> deposit(Account from);

        Promise<Integer> content();
    }

    /** Asks the payer for its content before it answers. */
    private static class PlainAccount extends Actor implements Account {
        @Override
        public Promise<Integer> pay(Account to) {
            return to.deposit(self());
        }

        @Override
        public Promise<Integer> deposit(Account from) {
            return from.content();
        }

        @Override
        public Promise<Integer> content() {
            return Promise.of(1);
        }
    }

    private static final class HoldingAccount extends PlainAccount {
        @Override
        public Promise<Integer> pay(Account to) {
            context().hold();
            return super.pay(to).eventually(() -> {
                context().release();
                return Promise.of(null);
            });
        }
    }

    private static void pay(TestSpace test, Supplier<Account> payer) {
        Account one = test.spawn(Account.class, payer, ActorSettings.named("one"));
        Account two = test.spawn(Account.class, PlainAccount::new, ActorSettings.named("two"));
        one.pay(two);
        test.runQueued();
    }

    private static WiringRecorder recorded(Consumer<TestSpace> program) {
        var recorder = new WiringRecorder("test");
        try (var test = new TestSpace(recorder)) {
            program.accept(test);
        }
        return recorder;
    }

    private static WiringMonitor monitored(Wiring wiring, Consumer<TestSpace> program) {
        var monitor = WiringMonitor.of(wiring).observing(WiringObserver.stepsFromOutside(wiring));
        try (var test = new TestSpace(new WiringObserver(monitor))) {
            program.accept(test);
            monitor.idle();
        }
        return monitor;
    }

    @Test
    void callThatIsAnsweredLater_isAcceptedAndAnswered() {
        var recorder = recorded(test -> pay(test, PlainAccount::new));
        assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(Proved.class);
        monitored(recorder.wiring(), test -> pay(test, PlainAccount::new)).check();
    }

    @Test
    void ringThatBlocks_isRecordedAsADeadlock_withWhatWasNotAnswered() {
        var recorder = recorded(test -> pay(test, HoldingAccount::new));
        assertThat(recorder.problems())
                .containsExactly(
                        "one has not answered pay from outside when the run ended",
                        "two has not answered deposit of one when the run ended",
                        "one has not begun content of two when the run ended");
        assertThat(WiringCheck.check(recorder.wiring()))
                .isInstanceOfSatisfying(
                        Deadlock.class,
                        deadlock ->
                                assertThat(deadlock.toString()).contains("one waits for", "two waits for one.content"));
    }

    @Test
    void changedRun_isRejected() {
        var wiring = recorded(test -> pay(test, PlainAccount::new)).wiring();
        var left = monitored(wiring, test -> {
            pay(test, () -> new PlainAccount() {
                @Override
                public Promise<Integer> content() {
                    return new Deferred<>(); // the answer is left out
                }
            });
        });
        assertThat(left.violation().orElseThrow().toString()).contains("one.content");
        var twice = monitored(
                wiring,
                test -> pay(test, () -> new PlainAccount() {
                    @Override
                    public Promise<Integer> pay(Account to) {
                        return super.pay(to).thenCompose(first -> super.pay(to));
                    }
                }));
        assertThat(twice.violation().orElseThrow().problem()).startsWith("one asks two.deposit is not allowed");
        var direct = monitored(
                wiring,
                test -> pay(test, () -> new PlainAccount() {
                    @Override
                    public Promise<Integer> pay(Account to) {
                        return to.content();
                    }
                }));
        assertThat(direct.violation().orElseThrow().problem()).contains("one asks two.content is not allowed");
    }

    @Test
    void javaSource_compiles_toTheSameWiring() throws Exception {
        var recorder = recorded(test -> {
            run(test);
            pay(test, PlainAccount::new);
        });
        var fromSource = compiled(recorder.java("io.troupe.petri.wiring", "PayWiring"), "PayWiring");
        assertThat(fromSource.net().toString())
                .isEqualTo(recorder.wiring().net().toString());
        assertThat(WiringCheck.check(fromSource))
                .hasToString(WiringCheck.check(recorder.wiring()).toString());
        assertThat(fromSource.protocol("two").steps())
                .isEqualTo(recorder.wiring().protocol("two").steps());
        monitored(fromSource, test -> pay(test, PlainAccount::new)).check();
    }

    @TempDir
    private Path folder;

    /** The class is defined beside this one, whose types are not public. */
    private Wiring compiled(String source, String name) throws Exception {
        Path file = Files.writeString(folder.resolve(name + ".java"), source);
        var errors = new StringWriter();
        boolean isGood = ToolProvider.getSystemJavaCompiler()
                .getTask(
                        errors,
                        null,
                        null,
                        List.of("-proc:none", "-d", folder.toString(), "-cp", System.getProperty("java.class.path")),
                        null,
                        ToolProvider.getSystemJavaCompiler()
                                .getStandardFileManager(null, null, null)
                                .getJavaFileObjects(file))
                .call();
        assertThat(isGood).as(errors + source).isTrue();
        byte[] bytes = Files.readAllBytes(folder.resolve("io/troupe/petri/wiring/" + name + ".class"));
        var method = MethodHandles.lookup().defineClass(bytes).getDeclaredMethod("wiring");
        return (Wiring) method.invoke(null);
    }

    @Test
    void callThatIsCancelledInTheMailbox_isRecorded() {
        Consumer<TestSpace> program = test -> {
            Server server = test.spawn(Server.class, Serving::new, ActorSettings.named("server"));
            Client client = test.spawn(Client.class, () -> () -> server.get().cancel(), ActorSettings.named("client"));
            client.go();
            test.runQueued();
        };
        var recorder = recorded(program);
        assertThat(recorder.wiring().protocol("client").steps(Step.Cancels.class))
                .hasSize(1);
        monitored(recorder.wiring(), program).check();
    }

    @Test
    void secondRun_addsToTheFirst() {
        var recorder = new WiringRecorder("test");
        for (int rounds = 1; rounds <= 2; rounds++) {
            recorder.newRun();
            try (var test = new TestSpace(recorder)) {
                run(test);
            }
        }
        recorder.newRun();
        try (var test = new TestSpace(recorder)) {
            pay(test, PlainAccount::new);
        }
        assertThat(recorder.wiring().components()).containsExactly("client", "one", "server", "two");
        monitored(recorder.wiring(), test -> pay(test, PlainAccount::new)).check();
        monitored(recorder.wiring(), WiringRecorderTest::run).check();
    }

    @Test
    void questionsOfOneCallAtTheSameTime_areAProblem_whichATranslationSolves() {
        Consumer<TestSpace> program = test -> {
            Server server = test.spawn(Server.class, Serving::new, ActorSettings.named("server"));
            Client client = test.spawn(
                    Client.class,
                    () -> () -> Promise.all(List.of(server.get(), server.get())),
                    ActorSettings.named("client"));
            client.go();
            test.runQueued();
        };
        assertThat(recorded(program).problems())
                .containsExactly(
                        "client asks server.get while an earlier one of it is open, which a protocol cannot express;"
                                + " a translation can give each its own component");
        var count = new int[1];
        WiringObserver.Translation apart = (from, to, call) -> call.method().equals("get")
                ? Optional.of(WiringObserver.Followed.of("client", "server" + (count[0]++ % 2) + ".get"))
                : Optional.empty();
        var recorder = new WiringRecorder("test", apart);
        try (var test = new TestSpace(recorder)) {
            program.accept(test);
        }
        assertThat(recorder.problems()).isEmpty();
        var monitor = WiringMonitor.of(recorder.wiring());
        try (var test = new TestSpace(new WiringObserver(monitor, apart))) {
            program.accept(test);
            monitor.idle();
        }
        monitor.check();
    }

    /** A reader asks the payer for its content: before a payment, or while that waits. */
    private static void payAndRead(TestSpace test, Supplier<Account> payer, boolean isReadMeanwhile) {
        var deposited = new Deferred<Integer>();
        Account one = test.spawn(Account.class, payer, ActorSettings.named("one"));
        Account two = test.spawn(
                Account.class,
                () -> new PlainAccount() {
                    @Override
                    public Promise<Integer> deposit(Account from) {
                        return deposited;
                    }
                },
                ActorSettings.named("two"));
        Client reader = test.spawn(Client.class, () -> one::content, ActorSettings.named("reader"));
        if (!isReadMeanwhile) {
            reader.go();
            test.runQueued();
        }
        one.pay(two);
        test.runQueued();
        if (isReadMeanwhile) {
            reader.go();
            test.runQueued();
        }
        deposited.resolve(1);
        test.runQueued();
    }

    @Test
    void callThatIsAnsweredAtOnce_isTakenInEachState_unlessTheActorHoldsItsCalls() {
        var plain = recorded(test -> payAndRead(test, PlainAccount::new, false)).wiring();
        monitored(plain, test -> payAndRead(test, PlainAccount::new, true)).check();
        var holding =
                recorded(test -> payAndRead(test, HoldingAccount::new, false)).wiring();
        assertThat(monitored(holding, test -> payAndRead(test, PlainAccount::new, true))
                        .violation()
                        .orElseThrow()
                        .problem())
                .startsWith("one takes content from reader is not allowed: one waits for the answer of two.deposit");
        monitored(holding, test -> payAndRead(test, HoldingAccount::new, true)).check();
    }

    /** The server goes on after its caller has given up, and the caller asks again. */
    @Test
    void callThatIsCancelledWhileItIsServed_isRecorded() {
        Consumer<TestSpace> program = test -> {
            var begun = new Deferred<Integer>();
            Server server = test.spawn(
                    Server.class,
                    () -> new Serving() {
                        @Override
                        public Promise<Integer> get() {
                            return begun.resolve(1) ? new Deferred<>() : Promise.of(2);
                        }
                    },
                    ActorSettings.named("server"));
            Client client = test.spawn(
                    Client.class,
                    () -> () -> {
                        var asked = server.get();
                        begun.then(any -> {
                            asked.cancel();
                            server.get();
                        });
                    },
                    ActorSettings.named("client"));
            client.go();
            test.runQueued();
        };
        var recorder = recorded(program);
        assertThat(recorder.problems()).isEmpty();
        assertThat(recorder.wiring().protocol("client").steps(Step.Cancels.class))
                .isNotEmpty();
        monitored(recorder.wiring(), program).check();
    }

    /** What has other names in the wiring, or several types, has none there. */
    @Test
    void componentWhoseCallsAreNotOfOneType_hasNone() {
        WiringObserver.Translation renamed = (from, to, call) -> call.method().equals("get")
                ? Optional.of(WiringObserver.Followed.of("client", "server.fetch"))
                : Optional.empty();
        WiringObserver.Translation joined = (from, to, call) -> call.type() == Client.class
                ? Optional.empty()
                : Optional.of(WiringObserver.Followed.of(
                        call.method().equals("deposit") ? "world" : "client", "world." + call.method()));
        for (var translation : List.of(renamed, joined)) {
            var recorder = new WiringRecorder("test", translation);
            try (var test = new TestSpace(recorder)) {
                run(test);
                pay(test, PlainAccount::new);
            }
            assertThat(WiringCheck.check(recorder.wiring())).isInstanceOf(Proved.class);
        }
    }

    @Test
    void source_compiles_whateverTheNamesAre() throws Exception {
        var count = new int[1];
        var recorder = new WiringRecorder(
                "the \"$test\" of \\",
                (from, to, call) -> call.method().equals("get")
                        ? Optional.of(WiringObserver.Followed.of(
                                "client",
                                List.of("server-a", "server_a", "Server-a").get(count[0]++ % 3) + ".get"))
                        : Optional.empty());
        try (var test = new TestSpace(recorder)) {
            run(test);
            run(test, ActorSettings.named("server2"), ActorSettings.named("client2"));
        }
        assertThat(recorder.wiring().components()).hasSize(4);
        var fromSource = compiled(recorder.java("io.troupe.petri.wiring", "NamedWiring"), "NamedWiring");
        assertThat(fromSource.name()).isEqualTo("the \"$test\" of \\");
        assertThat(fromSource.net().toString())
                .isEqualTo(recorder.wiring().net().toString());
        assertThat(recorder.kotlin("shop", "Named"))
                .contains("Wiring.of(\"the \\\"\\$test\\\" of \\\\\")")
                .containsOnlyOnce("val ofServer_a =")
                .containsOnlyOnce("val ofServer_a_2 =")
                .containsOnlyOnce("val ofServer_a_3 =");
    }
}
