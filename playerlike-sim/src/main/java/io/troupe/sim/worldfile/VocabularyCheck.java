package io.troupe.sim.worldfile;

import io.troupe.common.text.Suggestions;
import java.util.Collection;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;

/** Checks a tree against the {@link Vocabulary}: unknown names, wrong kinds of value, entities in the wrong place. */
final class VocabularyCheck {
    private final Document document;
    private final Diagnostics diagnostics;
    /** Properties already checked, by identity: those of a macro are shared by its instances and are checked once. */
    private final Set<Property> checkedInMacros = Collections.newSetFromMap(new IdentityHashMap<>());

    private final Set<Property> checkedInUse = Collections.newSetFromMap(new IdentityHashMap<>());
    /** What stands for a property that is wrong: nothing, or its usable part. */
    private final Map<Property, Optional<Property>> corrections = new IdentityHashMap<>();

    private final Set<Entity> misplaced = Collections.newSetFromMap(new IdentityHashMap<>());

    private VocabularyCheck(Document document, Diagnostics diagnostics) {
        this.document = document;
        this.diagnostics = diagnostics;
    }

    /**
     * Reports everything that is not in the vocabulary. Macros are checked too. A known property without effect is
     * reported only where a macro is used, so that include files with more content than a world needs can be read.
     *
     * @return the document without what a lenient reader leaves out, and with tuples of the expected length
     */
    static Document check(Document document, Diagnostics diagnostics) {
        var check = new VocabularyCheck(document, diagnostics);
        for (Entity macro : document.macros().values()) {
            if (!Vocabulary.isType(macro.type())) {
                check.unknownType(macro, Vocabulary.readableTypes());
            } else if (!Vocabulary.isWithoutUse(macro.type())) {
                check.inside(macro, false);
            }
        }
        check.inside(document.root(), true);
        return check.corrections.isEmpty() && check.misplaced.isEmpty()
                ? document
                : document.with(
                        property -> check.corrections.getOrDefault(property, Optional.of(property)),
                        entity -> !check.misplaced.contains(entity));
    }

    private void inside(Entity entity, boolean used) {
        Vocabulary.Type type = Vocabulary.type(entity.type());
        for (Property property : entity.properties().values()) {
            property(property, entity, type, used);
        }
        for (Entity child : entity.children()) {
            if (mayRead(child, entity, type, used)) {
                inside(child, used);
            }
        }
    }

    private void property(Property property, Entity entity, Vocabulary.Type type, boolean used) {
        if (!(used ? checkedInUse : checkedInMacros).add(property)) {
            return;
        }
        PropertyRule rule = type.properties().get(property.word());
        if (rule == null) {
            diagnostics.refuse(
                    property.where(),
                    "unknown property \"" + property.name() + "\" of " + entity.type()
                            + Suggestions.clauseOrAll(property.name(), type.usefulProperties()));
            return;
        }
        if (!rule.withoutEffect().isEmpty()) {
            if (used) {
                diagnostics.warn(property.where(), "\"" + property.name() + "\" " + rule.withoutEffect());
            }
            return;
        }
        try {
            Property usable = rule.checked(property, used ? diagnostics : null);
            if (usable != property) {
                corrections.put(property, Optional.of(usable));
            }
        } catch (WorldFileException e) {
            leaveOut(e);
            corrections.put(property, Optional.empty());
        }
    }

    /** Throws the exception again if the reader is strict. */
    private void leaveOut(WorldFileException e) {
        if (!diagnostics.isLenient()) {
            throw e;
        }
        diagnostics.warn(e.where().orElseThrow(), e.problem() + "; it is left out");
    }

    /** False for entities that are left out. */
    private boolean mayRead(Entity child, Entity parent, Vocabulary.Type parentType, boolean used) {
        if (parentType.children().contains(child.type())) {
            // the properties of Player's other drivers are not in the vocabulary
            return !child.type().equals("driver") || !child.has("name") || ConfigReader.mayBeStage(child);
        }
        if (Vocabulary.isWithoutUse(child.type())) {
            if (used) {
                diagnostics.warn(
                        child.where(),
                        "\"" + child.type() + "\" is not simulated and left out; simulated are model, position, ranger,"
                                + " laser, blobfinder, fiducial, bumper, camera and gripper");
            }
            return false;
        }
        if (Vocabulary.isSensor(child.type()) && parent.type().equals(Vocabulary.WORLD)) {
            diagnostics.warn(
                    child.where(),
                    "a " + child.type() + " that hangs on no robot (a position) is not read and left out");
            return false;
        }
        if (Vocabulary.isType(child.type())) {
            leaveOut(new WorldFileException(
                    child.where(),
                    "\"" + child.type() + "\" cannot stand in a " + parent.type() + "; it belongs in a "
                            + String.join(" or a ", Vocabulary.holdersOf(child.type()))));
            misplaced.add(child);
            return false;
        }
        unknownType(child, parentType.children());
        return false;
    }

    private void unknownType(Entity entity, Collection<String> builtIn) {
        var known = new TreeSet<>(builtIn);
        known.addAll(document.macros().keySet());
        diagnostics.refuse(
                entity.where(),
                "unknown entity \"" + entity.type() + '"' + Suggestions.clauseOrAll(entity.type(), known));
    }
}
