package io.troupe.actor;

import static org.objectweb.asm.Opcodes.*;

import io.troupe.actor.promise.Node;
import io.troupe.actor.promise.Promise;
import java.lang.reflect.Method;
import org.objectweb.asm.ClassWriter;
import org.objectweb.asm.Label;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Type;

/** Generates the message class of one method: its arguments in typed fields, and the call. */
final class MessageGenerator {
    private static final String CELL_DESCRIPTOR = Type.getDescriptor(ActorCell.class);

    private final Class<?> type;
    private final Method method;
    private final String name;
    private final Type[] arguments;
    private final boolean oneWay;
    private final String result;

    MessageGenerator(Class<?> type, Method method, String name) {
        this.type = type;
        this.method = method;
        this.name = name;
        this.arguments = Type.getArgumentTypes(method);
        this.oneWay = method.getReturnType() == void.class;
        this.result = oneWay ? "V" : Type.getDescriptor(Promise.class);
    }

    byte[] generate() {
        var writer = new ClassWriter(ClassWriter.COMPUTE_MAXS);
        String parent = Type.getInternalName(oneWay ? Message.class : Request.class);
        writer.visit(V21, ACC_FINAL | ACC_SUPER | ACC_SYNTHETIC, name, null, parent, null);
        for (int index = 0; index < arguments.length; index++) {
            writer.visitField(ACC_FINAL, "a" + index, arguments[index].getDescriptor(), null, null)
                    .visitEnd();
        }
        constructor(writer, parent);
        serve(writer, parent);
        invoke(writer);
        methodName(writer);
        argumentArray(writer);
        writer.visitEnd();
        return writer.toByteArray();
    }

    private void constructor(ClassWriter writer, String parent) {
        var descriptor = new StringBuilder("(").append(CELL_DESCRIPTOR);
        for (Type argument : arguments) {
            descriptor.append(argument.getDescriptor());
        }
        MethodVisitor code =
                writer.visitMethod(0, "<init>", descriptor.append(")V").toString(), null, null);
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitVarInsn(ALOAD, 1);
        code.visitMethodInsn(INVOKESPECIAL, parent, "<init>", "(" + CELL_DESCRIPTOR + ")V", false);
        int local = 2;
        for (int index = 0; index < arguments.length; index++) {
            code.visitVarInsn(ALOAD, 0);
            code.visitVarInsn(arguments[index].getOpcode(ILOAD), local);
            code.visitFieldInsn(PUTFIELD, name, "a" + index, arguments[index].getDescriptor());
            local += arguments[index].getSize();
        }
        code.visitInsn(RETURN);
        finish(code);
    }

    /** Overrides the parent's method with the same code, so that the call site of {@code invoke} is monomorphic. */
    private void serve(ClassWriter writer, String parent) {
        String node = Type.getDescriptor(Node.class);
        MethodVisitor code =
                writer.visitMethod(ACC_PROTECTED, "serve", "()" + node, null, new String[] {"java/lang/Throwable"});
        var nobody = new Label();
        code.visitCode();
        code.visitVarInsn(ALOAD, 0);
        code.visitMethodInsn(INVOKEVIRTUAL, parent, "target", "()Ljava/lang/Object;", false);
        code.visitVarInsn(ASTORE, 1);
        code.visitVarInsn(ALOAD, 1);
        code.visitJumpInsn(IFNULL, nobody);
        code.visitVarInsn(ALOAD, 0);
        if (!oneWay) {
            code.visitInsn(DUP);
        }
        code.visitVarInsn(ALOAD, 1);
        code.visitMethodInsn(INVOKEVIRTUAL, name, "invoke", "(Ljava/lang/Object;)" + result, false);
        if (oneWay) {
            code.visitInsn(ACONST_NULL);
        } else {
            code.visitMethodInsn(INVOKEVIRTUAL, parent, "answer", "(" + result + ")" + node, false);
        }
        code.visitInsn(ARETURN);
        code.visitLabel(nobody);
        code.visitFrame(F_APPEND, 1, new Object[] {"java/lang/Object"}, 0, null);
        code.visitInsn(ACONST_NULL);
        code.visitInsn(ARETURN);
        finish(code);
    }

    private void invoke(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(
                ACC_PROTECTED, "invoke", "(Ljava/lang/Object;)" + result, null, new String[] {"java/lang/Throwable"});
        code.visitCode();
        code.visitVarInsn(ALOAD, 1);
        code.visitTypeInsn(CHECKCAST, Type.getInternalName(type));
        for (int index = 0; index < arguments.length; index++) {
            loadArgument(code, index);
        }
        boolean isInterface = type.isInterface();
        code.visitMethodInsn(
                isInterface ? INVOKEINTERFACE : INVOKEVIRTUAL,
                Type.getInternalName(type),
                method.getName(),
                Type.getMethodDescriptor(method),
                isInterface);
        code.visitInsn(oneWay ? RETURN : ARETURN);
        finish(code);
    }

    private void methodName(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(ACC_PROTECTED, "method", "()Ljava/lang/String;", null, null);
        code.visitCode();
        code.visitLdcInsn(type.getSimpleName() + "." + ActorMethods.signature(method));
        code.visitInsn(ARETURN);
        finish(code);
    }

    private void argumentArray(ClassWriter writer) {
        MethodVisitor code = writer.visitMethod(ACC_PROTECTED, "arguments", "()[Ljava/lang/Object;", null, null);
        code.visitCode();
        code.visitIntInsn(SIPUSH, arguments.length);
        code.visitTypeInsn(ANEWARRAY, "java/lang/Object");
        for (int index = 0; index < arguments.length; index++) {
            code.visitInsn(DUP);
            code.visitIntInsn(SIPUSH, index);
            loadArgument(code, index);
            box(code, arguments[index]);
            code.visitInsn(AASTORE);
        }
        code.visitInsn(ARETURN);
        finish(code);
    }

    private void loadArgument(MethodVisitor code, int index) {
        code.visitVarInsn(ALOAD, 0);
        code.visitFieldInsn(GETFIELD, name, "a" + index, arguments[index].getDescriptor());
    }

    private static void box(MethodVisitor code, Type primitive) {
        String wrapper = switch (primitive.getSort()) {
            case Type.BOOLEAN -> "Boolean";
            case Type.CHAR -> "Character";
            case Type.BYTE -> "Byte";
            case Type.SHORT -> "Short";
            case Type.INT -> "Integer";
            case Type.LONG -> "Long";
            case Type.FLOAT -> "Float";
            case Type.DOUBLE -> "Double";
            default -> null;
        };
        if (wrapper != null) {
            code.visitMethodInsn(
                    INVOKESTATIC,
                    "java/lang/" + wrapper,
                    "valueOf",
                    "(" + primitive.getDescriptor() + ")Ljava/lang/" + wrapper + ";",
                    false);
        }
    }

    private static void finish(MethodVisitor code) {
        code.visitMaxs(0, 0);
        code.visitEnd();
    }
}
