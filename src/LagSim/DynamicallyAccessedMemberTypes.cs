#if NETSTANDARD2_1
namespace System.Diagnostics.CodeAnalysis;

/// <summary>Kinds of members, as <see cref="DynamicallyAccessedMembersAttribute"/> names them.</summary>
[Flags]
internal enum DynamicallyAccessedMemberTypes
{
    PublicMethods = 0x8,
    PublicFields = 0x20,
    NonPublicFields = 0x40,
}
#endif
