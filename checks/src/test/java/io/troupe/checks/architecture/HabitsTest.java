package io.troupe.checks.architecture;

import static com.tngtech.archunit.lang.conditions.ArchConditions.accessTargetWhere;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.fields;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noFields;
import static com.tngtech.archunit.library.GeneralCodingRules.ACCESS_STANDARD_STREAMS;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import com.tngtech.archunit.base.DescribedPredicate;
import com.tngtech.archunit.core.domain.JavaAccess;
import com.tngtech.archunit.core.domain.JavaClass;
import com.tngtech.archunit.core.domain.JavaConstructorCall;
import com.tngtech.archunit.core.domain.JavaField;
import java.util.Collection;
import java.util.Map;
import java.util.Set;
import java.util.random.RandomGenerator;
import org.junit.jupiter.api.Test;

/** What no class may do, with the named exceptions. */
class HabitsTest {
    /** The mutable statics that the design allows, each by name. */
    private static final Set<String> MUTABLE_STATICS = Set.of(
            "io.troupe.actor.ActorSpace$Global.SPACE", // the global space
            "io.troupe.actor.ActorType.ACTORS", // the cache of generated classes
            "io.troupe.actor.ActorType.POOLS", // the same for pools
            // which classes of callbacks have their own isCancelled()
            "io.troupe.actor.ReturningCallback.OWN_IS_CANCELLED",
            "io.troupe.actor.BlockingTaskThreads.POOL", // threads for bodies, shared by all spaces
            "io.troupe.actor.Watchdog.LOOKS", // the one thread that watches all spaces
            "io.troupe.actor.HandlerTurn.OTHERS", // the handlers that a thread runs, one set per thread
            "io.troupe.actor.internal.loop.Home.CURRENT", // the home a thread belongs to, one per thread
            // listeners that wait for their turn on a thread without a home, one per thread
            "io.troupe.actor.Listeners.DETACHED",
            "io.troupe.player.PlayerPorts.OPEN"); // the in-process Player ports

    /** The classes that may read the clock or wait for a time. */
    private static final Map<String, Set<String>> CLOCKS = Map.of(
            "java.lang.System", Set.of("nanoTime", "currentTimeMillis"),
            "java.lang.Thread", Set.of("sleep"),
            "java.time.Clock", Set.of("systemUTC", "systemDefaultZone", "system"),
            "java.time.Instant", Set.of("now"),
            "java.time.LocalDate", Set.of("now"),
            "java.time.LocalDateTime", Set.of("now"),
            "java.time.LocalTime", Set.of("now"),
            "java.time.ZonedDateTime", Set.of("now"));

    @Test
    void everyPackage_isNullMarked() {
        assertThat(Classes.MAIN.stream()
                        .filter(each -> !each.isAnnotatedWith("kotlin.Metadata")) // null types are in the language
                        .map(JavaClass::getPackage)
                        .distinct())
                .as("packages whose package-info.java is there and @NullMarked")
                .allMatch(each -> each.isAnnotatedWith("org.jspecify.annotations.NullMarked"));
    }

    @Test
    void standardStreams_areUsedByCommandLinesOnly() {
        noClasses()
                .that()
                .resideOutsideOfPackages("io.troupe.tools", "io.troupe.demo..", "io.troupe.bench..", "io.troupe.paper")
                .should(ACCESS_STANDARD_STREAMS)
                .check(Classes.MAIN);
    }

    @Test
    void machineTime_isAskedForByTheClockOnly() {
        var clock = DescribedPredicate.<JavaAccess<?>>describe(
                "asks the machine for the time or sleeps",
                access -> CLOCKS.getOrDefault(access.getTargetOwner().getName(), Set.of())
                        .contains(access.getTarget().getName()));
        noClasses()
                .that()
                .resideOutsideOfPackages("io.troupe.tools", "io.troupe.demo..", "io.troupe.bench..", "io.troupe.paper")
                .and()
                .doNotHaveFullyQualifiedName("io.troupe.actor.SystemClock")
                .should(accessTargetWhere(clock))
                .check(Classes.MAIN);
    }

    /**
     * A thread of the common pool that waits for an exit can block while a surviving child of the process holds its
     * pipe.
     */
    @Test
    void endsOfProcesses_areAwaitedByThreadsOnly() {
        var awaitsInThePool = DescribedPredicate.<JavaAccess<?>>describe(
                "waits for a process in the common pool",
                access -> access.getTarget().getName().equals("onExit")
                        && access.getTargetOwner().getName().startsWith("java.lang.Process"));
        noClasses().should(accessTargetWhere(awaitsInThePool)).check(Classes.MAIN);
    }

    @Test
    void staticFields_areFinal() {
        fields().that().areStatic().should().beFinal().check(Classes.MAIN);
    }

    @Test
    void staticFields_holdNothingThatIsMadeToChange() {
        noFields()
                .that()
                .areStatic()
                .and(DescribedPredicate.describe(
                        "are not among the exceptions of the design",
                        field -> !MUTABLE_STATICS.contains(field.getFullName())))
                .should()
                .haveRawType(DescribedPredicate.describe("is made to change", HabitsTest::isMadeToChange))
                .check(Classes.MAIN);
    }

    /** Also finds a mutable map in a field that is declared as {@code Map}. */
    @Test
    void staticInitializers_makeNothingThatIsMadeToChange() {
        var owners = MUTABLE_STATICS.stream().map(field -> field.substring(0, field.lastIndexOf('.')));
        var allowed = owners.collect(toSet());
        var made = Classes.MAIN.stream()
                .filter(each -> !allowed.contains(each.getName()))
                .flatMap(each -> each.getStaticInitializer().stream())
                .flatMap(initializer -> initializer.getConstructorCallsFromSelf().stream())
                .filter(call -> isMadeToChange(call.getTargetOwner()))
                .map(JavaConstructorCall::getDescription)
                .toList();
        assertThat(made).as("mutable objects made for static fields").isEmpty();
    }

    @Test
    void mutableStatics_thatAreAllowed_exist() {
        var all = Classes.MAIN.stream().flatMap(each -> each.getFields().stream());
        assertThat(all).extracting(JavaField::getFullName).containsAll(MUTABLE_STATICS);
    }

    private static boolean isMadeToChange(JavaClass type) {
        return type.getPackageName().startsWith("java.util.concurrent") && !type.isEnum()
                || type.isEquivalentTo(StringBuilder.class)
                || type.isAssignableTo(ClassValue.class)
                || type.isAssignableTo(ThreadLocal.class)
                || type.isAssignableTo(Thread.class)
                || type.isAssignableTo(RandomGenerator.class)
                || type.isAssignableTo("io.troupe.actor.ActorSpace")
                || !type.isInterface() && (type.isAssignableTo(Collection.class) || type.isAssignableTo(Map.class));
    }
}
