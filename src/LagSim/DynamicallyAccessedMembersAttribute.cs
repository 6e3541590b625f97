#if NETSTANDARD2_1
namespace System.Diagnostics.CodeAnalysis;

/// <summary>Which members of a type reflection needs: .NET 5 and later know it, and trimming heeds it by name.</summary>
[AttributeUsage(AttributeTargets.Class | AttributeTargets.GenericParameter | AttributeTargets.Parameter)]
internal sealed class DynamicallyAccessedMembersAttribute(DynamicallyAccessedMemberTypes memberTypes) : Attribute
{
    public DynamicallyAccessedMemberTypes MemberTypes { get; } = memberTypes;
}
#endif
