package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.bus.internal.Portable;
import io.troupe.bus.internal.RecordCodec;
import io.troupe.bus.internal.RecordCopier;
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
import org.assertj.core.api.AbstractThrowableAssert;
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

    sealed interface Leaky permits Closed {}

    static final class Closed implements Leaky {}

    record Named(Map<String, List<Integer>> lists) {}

    record Texts(List<String> texts) {}

    record Link(int value, @Nullable Link next) {}

    sealed interface Tree {
        record Leaf() implements Tree {}

        record Fork(Tree left, Tree right) implements Tree {}

        record Root(Tree tree) {}
    }

    private final RecordCopier copier = new RecordCopier();

    private AbstractThrowableAssert<?, ?> assertCopyRefused(Record value) {
        return assertThatThrownBy(() -> copier.copy(value)).isInstanceOf(IllegalArgumentException.class);
    }

    private static void assertRefused(Class<? extends Record> type, String path, String componentType, String why) {
        assertThatThrownBy(() -> new BusTopic<>("t", type))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith("topic t: values of " + type.getName() + " cannot leave a process because of "
                        + path + " of type " + componentType + ": ")
                .hasMessageContaining(why);
    }

    @Test
    void valuesAllTheWayDown_areAccepted_evenRecursiveOnes_andRecordsOfTheBusItself() {
        assertThat(new BusTopic<>("t", Everything.class).type()).isEqualTo(Everything.class);
        assertThat(new BusTopic<>("t", Shape.Many.class).name()).isEqualTo("t");
        assertThat(new BusTopic<>("a", Address.class).type()).isEqualTo(Address.class);
        var failed = BusMessage.Failure.Failed.class;
        assertThat(new BusTopic<>("f", failed).type()).isEqualTo(failed);
    }

    @Test
    @SuppressWarnings("rawtypes")
    void componentThatCannotLeave_isRefused_byItsPathAndType() {
        record Inner(Runnable action) {}
        record Outer(List<Inner> inners) {}
        record OfObject(Object anything) {}
        record OfSet(Set<String> names) {}
        record OfKeys(Map<Integer, String> names) {}
        record OfRaw(List raw) {}
        record OfVariable<T>(T value) {}
        record OfWildcard(List<? extends Plain> plains) {}
        record OfLeaky(Leaky leaky) {}
        assertRefused(OfArray.class, "OfArray.ranges", "double[]", "use a List");
        assertRefused(Outer.class, "Outer.inners[].action", "java.lang.Runnable", "expected primitives");
        assertRefused(OfObject.class, "OfObject.anything", "java.lang.Object", "expected primitives");
        assertRefused(OfSet.class, "OfSet.names", "java.util.Set<java.lang.String>", "expected primitives");
        String ofKeys = "java.util.Map<java.lang.Integer, java.lang.String>";
        assertRefused(OfKeys.class, "OfKeys.names", ofKeys, "the keys of a Map have to be String");
        assertRefused(OfRaw.class, "OfRaw.raw", "java.util.List", "it does not name its element type");
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
        var copy = copier.copy(new Shape.Many(List.of(new Shape.Many(inner))));
        inner.clear();
        assertThat(copy).isEqualTo(new Shape.Many(List.of(new Shape.Many(List.of(new Shape.Circle(1))))));
        var shapes = ((Shape.Many) copy.shapes().getFirst()).shapes();
        assertThatThrownBy(shapes::clear).isInstanceOf(UnsupportedOperationException.class);
    }

    @Test
    void maps_areCopied_andKeepTheirOrder() {
        var lists = new LinkedHashMap<String, List<Integer>>();
        for (String name : List.of("z", "a", "m", "b")) {
            lists.put(name, new ArrayList<>(List.of(1)));
        }
        var copy = copier.copy(new Named(lists)).lists();
        lists.values().forEach(List::clear);
        lists.clear();
        assertThat(copy.keySet()).containsExactly("z", "a", "m", "b");
        assertThat(copy.values()).containsOnly(List.of(1));
        assertThatThrownBy(copy::clear).isInstanceOf(UnsupportedOperationException.class);
    }

    @Test
    void nullInAListOrAMap_isRefused_byItsPlace() {
        assertCopyRefused(new Texts(Arrays.asList("a", null)))
                .hasMessage("a value of " + Texts.class.getName()
                        + " cannot leave the process: a list in it has null at 1, expected values, and no null in lists"
                        + " and maps, in at most 500 levels of records, lists and maps");
        assertThat(copier.copy(new Texts(Collections.emptyList())).texts()).isEmpty();
        assertCopyRefused(new Named(Collections.singletonMap("left", null)))
                .hasMessageStartingWith("a value of " + Named.class.getName()
                        + " cannot leave the process: a map in it has null for \"left\", expected values");
        assertCopyRefused(new Named(Collections.singletonMap(null, List.of())))
                .hasMessageContaining("a map in it has the key null");
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
            assertCopyRefused(deep)
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
        assertCopyRefused(links(Portable.MAX_LEVELS + 1));
    }

    @Test
    void everyKindOfValue_goesThroughBytesUnchanged() {
        var circle = new Shape.Circle(0.5);
        var deep = List.of(Map.of("a", Optional.<Shape>of(new Shape.Many(List.of()))));
        var value = new Everything(
                true, (byte) 1, 'c', 2, "text", Colour.RED, Duration.ofMillis(5), Instant.EPOCH, circle, deep);
        var codec = new RecordCodec();
        assertThat(codec.decode(codec.encode(value), Everything.class)).isEqualTo(value);
    }
}
