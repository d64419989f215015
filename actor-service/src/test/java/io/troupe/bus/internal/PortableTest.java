package io.troupe.bus.internal;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import org.jspecify.annotations.Nullable;
import org.junit.jupiter.api.Test;

class PortableTest {
    enum Colour {
        RED
    }

    sealed interface Shape {
        record Circle(double radiusM) implements Shape {}

        record Many(List<Shape> shapes) implements Shape {}
    }

    record Everything(
            boolean flag,
            byte b,
            char c,
            Integer boxed,
            String text,
            Colour colour,
            Duration duration,
            Instant instant,
            Shape shape,
            List<Map<String, Optional<Shape>>> deep) {}

    record Plain(int value, String text) {}

    record OfArray(double[] ranges) {}

    record Inner(Runnable action) {}

    record Outer(List<Inner> inners) {}

    record OfObject(Object anything) {}

    record OfSet(Set<String> names) {}

    record OfKeys(Map<Integer, String> names) {}

    @SuppressWarnings("rawtypes")
    record OfRaw(List raw) {}

    record OfVariable<T>(T value) {}

    record OfWildcard(List<? extends Plain> plains) {}

    sealed interface Leaky permits Closed {}

    static final class Closed implements Leaky {}

    record OfLeaky(Leaky leaky) {}

    private final RecordCopier copier = new RecordCopier();

    private static void assertRefused(Class<? extends Record> type, String path, String componentType, String why) {
        assertThatThrownBy(() -> new BusTopic<>("t", type))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith("topic t: values of " + type.getName() + " cannot leave a process because of "
                        + path + " of type " + componentType + ": ")
                .hasMessageContaining(why);
    }

    @Test
    void valuesAllTheWayDown_areAccepted_evenRecursiveOnes() {
        assertThat(new BusTopic<>("t", Everything.class).type()).isEqualTo(Everything.class);
        assertThat(new BusTopic<>("t", Shape.Many.class).name()).isEqualTo("t");
    }

    @Test
    void componentThatCannotLeave_isRefused_byItsPathAndType() {
        assertRefused(OfArray.class, "OfArray.ranges", "double[]", "use a List");
        assertRefused(Outer.class, "Outer.inners[].action", "java.lang.Runnable", "expected primitives");
        assertRefused(OfObject.class, "OfObject.anything", "java.lang.Object", "expected primitives");
        assertRefused(OfSet.class, "OfSet.names", "java.util.Set<java.lang.String>", "expected primitives");
        assertRefused(
                OfKeys.class,
                "OfKeys.names",
                "java.util.Map<java.lang.Integer, java.lang.String>",
                "the keys of a Map have to be String");
        assertRefused(OfRaw.class, "OfRaw.raw", "java.util.List", "it does not say of what");
        assertRefused(OfVariable.class, "OfVariable.value", "T", "it is not known which type that is");
        assertRefused(OfWildcard.class, "OfWildcard.plains[]", "? extends " + Plain.class.getName(), "not known");
        assertRefused(OfLeaky.class, "OfLeaky.leaky(Closed)", Closed.class.getName(), "expected primitives");
        assertRefused(Record.class, "Record", "java.lang.Record", "it is no record");
    }

    @Test
    void operation_checksRequestAndAnswer() {
        assertThatThrownBy(() -> new Operation<>("o", Plain.class, OfArray.class, Operation.Kind.DATA))
                .hasMessageStartingWith("operation o: values of " + OfArray.class.getName());
        assertThatThrownBy(() -> new Operation<>("o", OfArray.class, Plain.class, Operation.Kind.DATA))
                .hasMessageStartingWith("operation o: values of " + OfArray.class.getName());
        assertThatThrownBy(() -> new Operation<>(" ", Plain.class, Plain.class, Operation.Kind.DATA))
                .hasMessage("the name of an operation is blank");
        assertThatThrownBy(() -> new BusTopic<>("", Plain.class)).hasMessage("the name of a topic is blank");
    }

    @Test
    void recordsOfTheBusItself_canLeave() {
        assertThat(new BusTopic<>("a", Address.class).type()).isEqualTo(Address.class);
        assertThat(new BusTopic<>("f", BusMessage.Failure.Failed.class).type())
                .isEqualTo(BusMessage.Failure.Failed.class);
    }

    // ---- defensive copies

    @Test
    void valueWithoutContainers_isNotCopied() {
        var plain = new Plain(1, "a");
        assertThat(copier.copy(plain)).isSameAs(plain);
        var immutable = new Shape.Many(List.of(new Shape.Circle(1), new Shape.Many(List.of())));
        assertThat(copier.copy(immutable)).isSameAs(immutable);
    }

    @Test
    void listsAtAnyDepth_areCopied() {
        var inner = new ArrayList<Shape>(List.of(new Shape.Circle(1)));
        var value = new Shape.Many(List.of(new Shape.Many(inner)));
        var copy = copier.copy(value);
        assertThat(copy).isEqualTo(value);
        inner.clear();
        assertThat(copy).isEqualTo(new Shape.Many(List.of(new Shape.Many(List.of(new Shape.Circle(1))))));
        assertThatThrownBy(
                        () -> ((Shape.Many) copy.shapes().getFirst()).shapes().clear())
                .isInstanceOf(UnsupportedOperationException.class);
    }

    record Named(Map<String, List<Integer>> lists) {}

    @Test
    void maps_areCopied_andKeepTheirOrder() {
        var lists = new LinkedHashMap<String, List<Integer>>();
        for (String name : List.of("z", "a", "m", "b")) {
            lists.put(name, new ArrayList<>(List.of(1)));
        }
        var copy = copier.copy(new Named(lists));
        lists.values().forEach(List::clear);
        lists.clear();
        assertThat(copy.lists().keySet()).containsExactly("z", "a", "m", "b");
        assertThat(copy.lists().values()).containsOnly(List.of(1));
        assertThatThrownBy(() -> copy.lists().clear()).isInstanceOf(UnsupportedOperationException.class);
    }

    record Texts(List<String> texts) {}

    @Test
    void nullInAList_isRefused_byItsPlace() {
        assertThatThrownBy(() -> copier.copy(new Texts(Arrays.asList("a", null))))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("a value of " + Texts.class.getName()
                        + " cannot leave the process: a list in it has null at 1, expected values, and no null in lists and"
                        + " maps, in at most 500 levels of records, lists and maps");
        assertThat(copier.copy(new Texts(Collections.emptyList())).texts()).isEmpty();
    }

    @Test
    void nullInAMap_isRefused_asAKeyAndAsAValue() {
        var values = new LinkedHashMap<String, List<Integer>>();
        values.put("left", null);
        assertThatThrownBy(() -> copier.copy(new Named(values)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith("a value of " + Named.class.getName()
                        + " cannot leave the process: a map in it has null for \"left\", expected values");
        var keys = new LinkedHashMap<String, List<Integer>>();
        keys.put(null, List.of());
        assertThatThrownBy(() -> copier.copy(new Named(keys)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("a map in it has the key null");
    }

    record Link(int value, @Nullable Link next) {}

    sealed interface Tree {
        record Leaf() implements Tree {}

        record Fork(Tree left, Tree right) implements Tree {}

        record Root(Tree tree) {}
    }

    private static Link links(int count) {
        Link links = null;
        for (int i = 0; i < count; i++) {
            links = new Link(i, links);
        }
        return links;
    }

    @Test
    void valueThatIsNestedTooDeep_isRefused_byItsName() {
        Tree tree = new Tree.Leaf();
        Shape shape = new Shape.Circle(1);
        for (int i = 0; i < 200_000; i++) {
            tree = new Tree.Fork(tree, new Tree.Leaf());
            shape = new Shape.Many(List.of(shape));
        }
        for (Record deep : List.of(links(200_000), new Tree.Root(tree), (Shape.Many) shape)) {
            assertThatThrownBy(() -> copier.copy(deep))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageStartingWith("a value of " + deep.getClass().getName()
                            + " cannot leave the process: it is nested deeper than 500 levels, expected");
        }
    }

    @Test
    void copierAndCodec_takeTheSameDepth() {
        var deepest = links(Portable.MAX_LEVELS);
        assertThat(copier.copy(deepest)).isSameAs(deepest);
        var codec = new RecordCodec();
        assertThat(codec.decode(codec.encode(deepest), deepest.getClass())).isEqualTo(deepest);
        assertThatThrownBy(() -> copier.copy(links(Portable.MAX_LEVELS + 1)))
                .isInstanceOf(IllegalArgumentException.class);
    }

    @Test
    void everyKindOfValue_goesThroughBytesUnchanged() {
        var value = new Everything(
                true,
                (byte) 1,
                'c',
                2,
                "text",
                Colour.RED,
                Duration.ofMillis(5),
                Instant.EPOCH,
                new Shape.Circle(0.5),
                List.of(Map.of("a", Optional.of(new Shape.Many(List.of())))));
        var codec = new RecordCodec();
        assertThat(codec.decode(codec.encode(value), Everything.class)).isEqualTo(value);
    }
}
