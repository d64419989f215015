package hello;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.Promise;
import java.time.Duration;

public final class Hello {
    public interface Greeter {
        Promise<String> greet(String name);
    }

    public static void main(String[] args) throws Exception {
        try (var space = ActorSpace.create(SpaceSettings.named("hello"))) {
            Greeter greeter = space.spawn(Greeter.class, () -> name -> Promise.of("Hello, " + name));
            System.out.println(greeter.greet("Ada").get(Duration.ofSeconds(10)));
        }
    }
}
