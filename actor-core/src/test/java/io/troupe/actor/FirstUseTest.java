package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.time.Duration;
import java.util.List;
import java.util.function.Supplier;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/** What only a separate JVM shows: the first use of a class, and the exit of the program. */
@Tag("threads")
@Timeout(120)
class FirstUseTest {
    @Test
    void proxies_firstMadeAtTheEndOfAStack_canBeMadeLater() throws Exception {
        assertThat(ChildJvm.run(List.of(), EndOfTheStack.class).lines())
                .containsExactly("failed where the stack ends: true", "made later: hello");
    }

    @Test
    void classActor_onARuntimeWithoutTheModuleThatItNeeds_isRejectedWithItsName() throws Exception {
        ChildJvm.Result result = ChildJvm.run(List.of("--limit-modules", "java.management,jdk.jfr"), ClassActors.class);
        assertThat(result.lines())
                .containsExactly("the proxy of a class actor needs module jdk.unsupported, "
                        + "which this Java runtime does not have: link it with jdk.unsupported, "
                        + "or use an interface instead of " + Bell.class.getName());
    }

    @Test
    void exit_calledByAnActor_doesNotWaitForAHookThatClosesItsSpace() throws Exception {
        ChildJvm.Result result = ChildJvm.run(List.of(), Exiting.class);
        assertThat(result.lines()).containsExactly("the hook has closed the space");
        assertThat(result.exitStatus()).isEqualTo(3);
    }

    public interface Greeter {
        Promise<String> greet();

        void exit();
    }

    private static final class Plain implements Greeter {
        @Override
        public Promise<String> greet() {
            return Promise.of("hello");
        }

        @Override
        public void exit() {
            System.exit(3);
        }
    }

    /** Uses a pool's proxy for the first time where a stack ends, and again further up until that succeeds. */
    static final class EndOfTheStack {
        /** Linked before the stack ends: the JVM remembers a lambda that could not be linked. */
        private static final Supplier<Greeter> FACTORY = Plain::new;

        private boolean failed;
        private boolean made;

        public static void main(String[] arguments) throws Exception {
            try (var space = ActorSpace.create(SpaceSettings.named("members"))) {
                space.spawn(Greeter.class, FACTORY); // other classes of the library have been used
                var first = new EndOfTheStack();
                var thread = new Thread(null, () -> first.recurse(space, 0), "deep", 300_000);
                thread.start();
                thread.join();
                System.out.println("failed where the stack ends: " + first.failed);
                System.out.println(
                        "made later: " + pool(space).roundRobin().greet().get(Duration.ofSeconds(30)));
            }
        }

        private static ActorPool<Greeter> pool(ActorSpace space) {
            return ActorPool.on(List.of(space), Greeter.class, FACTORY, ActorSettings.defaults());
        }

        private int recurse(ActorSpace space, int frame) {
            try {
                return 1 + recurse(space, frame + 1);
            } catch (StackOverflowError end) {
                if (!made) {
                    failed = true;
                    pool(space).roundRobin();
                    made = true;
                }
                return 0;
            }
        }
    }

    static class Bell extends Actor {}

    static final class ClassActors {
        public static void main(String[] arguments) {
            try (var space = ActorSpace.create(SpaceSettings.named("classes"))) {
                space.spawn(Greeter.class, Plain::new);
                System.out.println("not rejected: " + space.spawn(Bell.class, Bell::new));
            } catch (ActorTypeException e) {
                System.out.println(e.getMessage());
            }
        }
    }

    /** An actor ends the program, whose shutdown hook closes the actor's space. */
    static final class Exiting {
        public static void main(String[] arguments) throws InterruptedException {
            var space = ActorSpace.create(SpaceSettings.named("exiting"));
            Runtime.getRuntime().addShutdownHook(new Thread(() -> {
                space.close();
                System.out.println("the hook has closed the space");
            }));
            space.spawn(Greeter.class, Plain::new).exit();
            Thread.currentThread().join(); // for ever: the actor ends the program
        }
    }
}
