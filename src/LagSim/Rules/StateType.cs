using System;
using System.Diagnostics.CodeAnalysis;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>Checks that every byte of a type of state means something, so that equal states have equal bytes.</summary>
/// <remarks>
/// Padding between fields may hold anything: a runtime need not clear or copy it. States are compared, hashed and sent as bytes.
/// </remarks>
internal static class StateType
{
    /// <summary>What has to be kept of such a type where code is trimmed.</summary>
    internal const DynamicallyAccessedMemberTypes Fields = DynamicallyAccessedMemberTypes.PublicFields | DynamicallyAccessedMemberTypes.NonPublicFields;

    private const BindingFlags OfInstance = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;

    /// <summary>The size of a type in bytes.</summary>
    /// <param name="most">The most bytes that are allowed.</param>
    /// <param name="whose">Whose state it is, for a message.</param>
    /// <exception cref="SceneException">It is larger, or has bytes that belong to no field.</exception>
    internal static int SizeOf<[DynamicallyAccessedMembers(Fields)] T>(int most, string whose)
        where T : unmanaged
    {
        int size = MemoryMarshal.AsBytes(stackalloc T[1]).Length;
        if (size > most)
        {
            throw new SceneException($"The state of {whose}, {typeof(T)}, takes {size} bytes; at most {most} are allowed.");
        }

        int used = Sum(typeof(T));
        return used == size ? size : throw new SceneException(
            $"The state of {whose}, {typeof(T)}, takes {size} bytes, of which its fields use {used}; there may be no padding. Order the fields from large to"
                + " small and fill up with spare ones, or say [StructLayout(LayoutKind.Sequential, Pack = 1)]. Native integers and pointers count nothing.");
    }

    [UnconditionalSuppressMessage("Trimming", "IL2075", Justification = "A nested type whose fields were trimmed is refused with a message.")]
    [UnconditionalSuppressMessage("Trimming", "IL2072", Justification = "A nested type whose fields were trimmed is refused with a message.")]
    private static int Sum([DynamicallyAccessedMembers(Fields)] Type type)
    {
        if (type.IsEnum)
        {
            return OfPrimitive(Enum.GetUnderlyingType(type));
        }

        if (type.IsPrimitive || type == typeof(decimal))
        {
            return OfPrimitive(type);
        }

        int sum = 0;
        foreach (FieldInfo field in type.GetFields(OfInstance))
        {
            FixedBufferAttribute? buffer = field.GetCustomAttribute<FixedBufferAttribute>();
            sum += buffer is null ? Sum(field.FieldType) : buffer.Length * OfPrimitive(buffer.ElementType);
        }

        return sum * Repeats(type);
    }

    // How often the one field of an inline array is there; the attribute is asked by name, since not every target has it.
    private static int Repeats(Type type)
    {
        foreach (CustomAttributeData attribute in type.GetCustomAttributesData())
        {
            if (string.Equals(attribute.AttributeType.FullName, "System.Runtime.CompilerServices.InlineArrayAttribute", StringComparison.Ordinal))
            {
                return (int)attribute.ConstructorArguments[0].Value!;
            }
        }

        return 1;
    }

    private static int OfPrimitive(Type type) => Type.GetTypeCode(type) switch
    {
        TypeCode.Boolean or TypeCode.Byte or TypeCode.SByte => 1,
        TypeCode.Char or TypeCode.Int16 or TypeCode.UInt16 => 2,
        TypeCode.Int32 or TypeCode.UInt32 or TypeCode.Single => 4,
        TypeCode.Int64 or TypeCode.UInt64 or TypeCode.Double => 8,
        TypeCode.Decimal => 16,
        _ => 0, // of another size on another processor
    };
}
